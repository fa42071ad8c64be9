#include "acquisition/residual/left_out.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "engine/files/measures.h"
#include "engine/lights/light_plane.h"

namespace nacre {

namespace {

constexpr double kLeastHullArea = 1e-3;

// The cost of judging grows with the square of the lights.
size_t samplePixels(size_t lights)
{
    return std::clamp<size_t>(size_t{25'000'000} / (lights * lights), 512, 2048);
}

std::string whyNoLayer(const std::vector<glm::vec3>& directions)
{
    if (directions.size() < kFewestResidualLights) {
        return fmt::format("{} lights are too few to guess between them", directions.size());
    }
    return LightHull(lightPlanePoints(directions)).area() < kLeastHullArea ? "the lights lie on a line" : "";
}

// An even sample of the shaded pixels.
Observations sampleOf(const Surface& surface, ObservationBlocks& blocks, size_t shaded, size_t most)
{
    const size_t stride = std::max<size_t>(1, (shaded + most - 1) / most);
    size_t seen = 0;
    Observations sample;
    while (const Observations* block = blocks.next()) {
        sample.lightCount = block->lightCount;
        sample.width = block->width;
        for (const size_t place : shadedPlaces(*block, surface)) {
            if (seen++ % stride == 0) {
                const auto radiance = block->radianceOf(place);
                const auto saturated = block->saturatedOf(place);
                sample.pixels.push_back(block->pixels[place]);
                sample.radiance.insert(sample.radiance.end(), radiance.begin(), radiance.end());
                sample.saturated.insert(sample.saturated.end(), saturated.begin(), saturated.end());
            }
        }
    }
    return sample;
}

std::vector<size_t> allPlaces(const Observations& sample)
{
    std::vector<size_t> places(sample.pixels.size());
    std::iota(places.begin(), places.end(), size_t{0});
    return places;
}

constexpr size_t kFewLights = 12; // each of which is left out alone
constexpr size_t kFolds = 6;      // of more lights: without a sixth of them BRDF and normals are nearly the same

// Pixels that cannot be measured without some lights keep what the whole surface says of them.
UnseenRows unseenRows(const Observations& sample, const ResidualRows& rows, const Remeasure& remeasure)
{
    const size_t lights = sample.lightCount, folds = lights <= kFewLights ? lights : kFolds;
    UnseenRows unseen;
    for (size_t fold = 0; fold < folds; ++fold) {
        std::vector<size_t> without;
        for (size_t light = fold; light < lights; light += folds) {
            without.push_back(light);
        }
        const Surface surface = remeasure(sample, without);
        std::vector<uint32_t> pixels(sample.pixels.size());
        std::iota(pixels.begin(), pixels.end(), 0u);
        Eigen::MatrixXf predicted = predictedRows(LightBalls(surface, 0, 1), pixels, lights);
        for (size_t p = 0; p < pixels.size(); ++p) {
            if (!isShaded(surface, p)) {
                const auto row = static_cast<Eigen::Index>(3 * p);
                predicted.middleRows<3>(row) = rows.predicted.middleRows<3>(row);
            }
        }
        unseen.folds.push_back(std::move(without));
        unseen.predicted.push_back(std::move(predicted));
    }
    return unseen;
}

float brightnessOf(const ResidualRows& rows, const std::vector<Light>& lights)
{
    std::vector<float> values;
    for (Eigen::Index row = 0; row < rows.observed.rows(); ++row) {
        for (size_t i = 0; i < lights.size(); ++i) {
            values.push_back(rows.observed(row, static_cast<Eigen::Index>(i)) * lights[i].irradiance[row % 3]);
        }
    }
    return peakOf(values);
}

size_t shadedPixels(const Surface& surface)
{
    size_t shaded = 0;
    for (size_t i = 0; i < surface.labels.size(); ++i) {
        shaded += isShaded(surface, i);
    }
    return shaded;
}

} // namespace

std::vector<glm::vec3> lightDirections(const Surface& surface)
{
    std::vector<glm::vec3> directions;
    for (const CapturedLight& light : surface.lights) {
        directions.push_back(light.light.direction);
    }
    return directions;
}

ResidualJudge judgeOf(const Surface& surface, const ResidualRows& rows)
{
    std::vector<Light> lights;
    for (const CapturedLight& light : surface.lights) {
        lights.push_back(light.light);
    }
    return {rows, lights, brightnessOf(rows, lights)};
}

LeftOut leaveOut(const Surface& surface, ObservationBlocks& blocks, const Remeasure& remeasure)
{
    LeftOut leftOut;
    leftOut.whyNot = whyNoLayer(lightDirections(surface));
    leftOut.shadedPixels = shadedPixels(surface);
    if (!leftOut.whyNot.empty() || leftOut.shadedPixels == 0) {
        return leftOut;
    }
    const Observations sample = sampleOf(surface, blocks, leftOut.shadedPixels, samplePixels(surface.lights.size()));
    leftOut.rows = residualRows(sample, allPlaces(sample), surface, LightBalls(surface, 0, 1));
    leftOut.unseen = unseenRows(sample, leftOut.rows, remeasure);
    return leftOut;
}

} // namespace nacre
