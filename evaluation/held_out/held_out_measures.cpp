#include "evaluation/held_out/held_out_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "acquisition/capture/capture_maps.h"
#include "acquisition/lights/sphere_outline.h"
#include "engine/scene/reference.h"

namespace nacre {

Predictions predictBySurface(const Surface& surface, const Observations& heldOut, const std::vector<Light>& lights,
                             int threads)
{
    const size_t count = heldOut.lightCount;
    Predictions predicted(heldOut.radiance.size());
    Scene scene{surface, {}, {0, 0, 1}};
    for (size_t j = 0; j < count; ++j) {
        scene.lights = {lights[j]};
        const Frame frame = renderReference(scene, threads);
        for (size_t p = 0; p < heldOut.pixels.size(); ++p) {
            const float* value = &frame.values[3 * size_t{heldOut.pixels[p]}];
            predicted[p * count + j] = {value[0], value[1], value[2]};
        }
    }
    return predicted;
}

float clippedError(float a, float b, double peak)
{
    const auto clipped = [&](float x) { return std::clamp(static_cast<float>(x / peak), 0.0f, 1.0f); };
    return clipped(a) - clipped(b);
}

double decibels(double squaredError, size_t count)
{
    return -10 * std::log10(std::max(squaredError / static_cast<double>(std::max<size_t>(count, 1)), 1e-30));
}

double pooledPsnr(const Predictions& predicted, const Observations& heldOut, double peak)
{
    double sum = 0;
    for (size_t i = 0; i < predicted.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            sum += std::pow(clippedError(predicted[i][c], heldOut.radiance[i][c], peak), 2);
        }
    }
    return decibels(sum, 3 * predicted.size());
}

Image pictureOf(const Observations& seen, std::span<const glm::vec3> radiance, size_t photograph, int width, int height)
{
    Image picture(width, height, 3);
    for (size_t p = 0; p < seen.pixels.size(); ++p) {
        const int x = static_cast<int>(seen.pixels[p] % width), y = static_cast<int>(seen.pixels[p] / width);
        picture.setRgb(x, y, radiance[p * seen.lightCount + photograph]);
    }
    return picture;
}

std::vector<float> relativeErrors(const Image& predicted, const Image& photograph, std::span<const uint8_t> mask,
                                  double floor)
{
    std::vector<float> errors;
    for (size_t i = 0; i < photograph.values.size(); ++i) {
        if (mask[i / photograph.channels]) {
            const double truth = photograph.values[i];
            errors.push_back(static_cast<float>(std::abs(predicted.values[i] - truth) / std::max(truth, floor)));
        }
    }
    return errors;
}

PhotographMeasures measurePhotograph(const Image& predicted, const Image& photograph, std::span<const uint8_t> mask,
                                     double peak)
{
    PhotographMeasures measures;
    measures.psnr = radiancePsnr(predicted, photograph, mask, peak);
    std::vector<float> errors = relativeErrors(predicted, photograph, mask, kRelativeErrorFloor * peak);
    measures.medianRelativeError = quantile(errors, 0.5);
    measures.percentile95RelativeError = quantile(errors, 0.95);
    const float stops = exposureOfPeak(peak);
    measures.structuralSimilarity = structuralSimilarity(displayedImage(predicted, {.exposureStops = stops}),
                                                         displayedImage(photograph, {.exposureStops = stops}), mask);
    return measures;
}

AngularError errorAgainstTruth(const Capture& capture, const NormalMap& normals, const std::filesystem::path& truth)
{
    const NormalMap map = truth == "sphere"
                              ? sphereNormals(fitCircle(capture.mask, capture.width, capture.height, capture.folder),
                                              capture.width, capture.height)
                              : windowedNormals(loadTrueNormals(truth), capture, truth);
    return angularError(normals, map, capture.mask);
}

size_t modelBytes(const Surface& surface)
{
    size_t bytes = 0;
    for (const Material& material : surface.materials) {
        bytes += bytesOf(material);
    }
    return bytes;
}

std::vector<size_t> heldOutIndices(size_t photographs, const LightChoice& choice)
{
    std::vector<size_t> chosen;
    for (size_t i = 0; i < photographs; ++i) {
        if (isHeldOutOfEvery(i, choice.heldOutEvery, choice.heldOutFirst)) {
            chosen.push_back(i);
        }
    }
    return chosen;
}

double psnrOf(const Surface& surface, const JudgingPhotographs& judging, int threads)
{
    return pooledPsnr(predictBySurface(surface, judging.seen, judging.lights, threads), judging.seen, judging.peak);
}

} // namespace nacre
