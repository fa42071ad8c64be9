#include "evaluation/held_out/photographed_object.h"

#include <limits>

#include <fmt/format.h>

#include "acquisition/capture/capture_maps.h"
#include "acquisition/lights/well_spread_lights.h"
#include "engine/files/error.h"
#include "engine/files/measures.h"

namespace nacre {

namespace {

NormalMap rowOf(const NormalMap& map, const std::vector<uint32_t>& pixels)
{
    NormalMap row(static_cast<int>(pixels.size()), 1);
    for (size_t p = 0; p < pixels.size(); ++p) {
        row.normals[p] = map.normals[pixels[p]];
        row.confidence[p] = map.confidence[pixels[p]];
    }
    return row;
}

constexpr size_t kMostPixels = 1000;

Observations wholeObject(const Capture& capture, int threads)
{
    ObservationReader reader(capture, threads, std::numeric_limits<size_t>::max());
    Observations whole;
    reader.next(whole);
    return whole;
}

// Every n-th row and column, renumbered as a grid of their own, with neighbours that a slope can be told from.
void thinOut(PhotographedObject& object, NormalMap& truth)
{
    int step = 1;
    while (object.seen.pixels.size() > kMostPixels * static_cast<size_t>(step * step)) {
        ++step;
    }
    const int width = (object.width + step - 1) / step, height = (object.height + step - 1) / step;
    const size_t n = object.seen.lightCount;
    Observations thin;
    NormalMap normals(width, height);
    thin.lightCount = n;
    thin.width = width;
    for (size_t p = 0; p < object.seen.pixels.size(); ++p) {
        const int x = static_cast<int>(object.seen.pixels[p]) % object.width,
                  y = static_cast<int>(object.seen.pixels[p]) / object.width;
        if (x % step == 0 && y % step == 0) {
            const int pixel = y / step * width + x / step;
            thin.pixels.push_back(static_cast<uint32_t>(pixel));
            normals.normals[pixel] = truth.normals[object.seen.pixels[p]];
            normals.confidence[pixel] = truth.confidence[object.seen.pixels[p]];
            const auto radiance = object.seen.radianceOf(p);
            const auto saturated = object.seen.saturatedOf(p);
            thin.radiance.insert(thin.radiance.end(), radiance.begin(), radiance.end());
            thin.saturated.insert(thin.saturated.end(), saturated.begin(), saturated.end());
        }
    }
    object.seen = std::move(thin);
    object.width = width;
    object.height = height;
    truth = std::move(normals);
}

} // namespace

PhotographedObject photographedScene(const SynthScene& scene)
{
    PhotographedObject object;
    object.name = "synthetic";
    object.lights = scene.lights;
    object.truth = rowOf(scene.view.normals, scene.view.seen);
    const size_t n = scene.lights.size();
    object.seen.lightCount = n;
    object.seen.width = scene.view.normals.width;
    object.seen.pixels = scene.view.seen;
    object.width = scene.view.normals.width;
    object.height = scene.view.normals.height;
    object.seen.radiance.resize(object.seen.pixels.size() * n);
    object.seen.saturated.assign(object.seen.radiance.size(), 0);
    for (size_t i = 0; i < n; ++i) {
        const Image radiance = objectRadiance(scene, scene.lights[i], scene.options.threads);
        for (size_t p = 0; p < object.seen.pixels.size(); ++p) {
            const uint32_t pixel = object.seen.pixels[p];
            object.seen.radiance[p * n + i] = radiance.rgb(pixel % radiance.width, pixel / radiance.width);
        }
        object.photographs.push_back(fmt::format("light {}", i + 1));
    }
    return object;
}

PhotographedObject photographedCapture(const Capture& capture, const CalibrationOptions& calibration)
{
    if (capture.truthNormals.empty()) {
        throw Error(capture.folder, "has no true normals", "Normal_gt.mat, or truthNormals in capture.json");
    }
    PhotographedObject object;
    object.name = capture.name;
    object.lights = calibrateLights(capture, calibration).lights;
    object.irradiancesKnown = capture.irradianceGiven || capture.diffuseSphere.has_value();
    for (const Photograph& photograph : capture.photographs) {
        object.photographs.push_back(photograph.name);
    }
    object.seen = wholeObject(capture, calibration.threads);
    object.width = capture.width;
    object.height = capture.height;
    NormalMap truth = windowedNormals(loadTrueNormals(capture.truthNormals), capture, capture.truthNormals);
    thinOut(object, truth);
    object.truth = rowOf(truth, object.seen.pixels);
    return object;
}

PhotographedObject selectPhotographs(const PhotographedObject& object, const std::vector<size_t>& chosen)
{
    PhotographedObject result = object;
    result.seen = selectLights(object.seen, chosen);
    result.lights = selectLights(object.lights, chosen);
    result.photographs.clear();
    for (const size_t i : chosen) {
        result.photographs.push_back(object.photographs[i]);
    }
    return result;
}

float valueQuantile(const Observations& seen, double q)
{
    std::vector<float> values;
    for (const glm::vec3& radiance : seen.radiance) {
        values.insert(values.end(), {radiance.x, radiance.y, radiance.z});
    }
    return quantile(values, q);
}

} // namespace nacre
