#include "assets/synth/synth_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/files/hash_random.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"
#include "engine/materials/material_specification.h"
#include "shared/shading.h"

namespace nacre {

SynthOptions demoCapture()
{
    SynthOptions options;
    options.width = 300;
    options.height = 300;
    options.sphereSize = 320;
    options.material = "ggx:diffuse=0.10,0.34,0.30;specular=0.05,0.045,0.035;alpha=0.15"; // celadon glaze
    options.seed = 7;
    return options;
}

namespace {

// Share of the spacing between lights by which each is moved: uneven, as placed by hand, yet none falls on another.
constexpr double kJitter = 0.3;
constexpr double kGoldenAngle = std::numbers::pi * (3.0 - 2.2360679774997896);

// Area-preserving: height on the cap and azimuth are both uniform.
glm::vec3 directionOnCap(double heightFromTop, double azimuth)
{
    double z = 1.0 - heightFromTop;
    double s = std::sqrt(std::max(0.0, 1.0 - z * z));
    return {s * std::cos(azimuth), s * std::sin(azimuth), z};
}

} // namespace

std::vector<Light> synthLights(const SynthOptions& options)
{
    const double capHeight = 1.0 - std::cos(options.capDegrees * std::numbers::pi / 180.0);
    const double spread = options.largestIrradiance - options.leastIrradiance;
    std::vector<Light> lights(options.lights);
    for (int i = 0; i < options.lights; ++i) {
        auto random = [&](uint64_t which) { return unitFromHash(hashOf(hashOf(options.seed, i), which)); };
        double step = (i + 0.5 + kJitter * (random(0) - 0.5)) / options.lights;
        double azimuth = (i + kJitter * (random(1) - 0.5)) * kGoldenAngle;
        lights[i].direction = directionOnCap(capHeight * step, azimuth);
        for (int c = 0; c < 3; ++c) {
            lights[i].irradiance[c] = static_cast<float>(options.leastIrradiance + spread * random(2 + c));
        }
    }
    return lights;
}

Image exposed(const Image& radiance, const Sensor& sensor, double seconds, uint64_t photograph)
{
    Image picture = radiance;
    const uint64_t stream = hashOf(sensor.seed, photograph);
    for (size_t i = 0; i < picture.values.size(); ++i) {
        double value = radiance.values[i] * sensor.gain * seconds;
        if (sensor.noise > 0.0) {
            value += sensor.noise * gaussianFromHash(hashOf(stream, i));
        }
        picture.values[i] = static_cast<float>(sensor.clips ? std::clamp(value, 0.0, 1.0) : value);
    }
    return picture;
}

namespace {

// Where the exposure puts the 99.5th percentile of the object's values, so that only the heart of a highlight clips.
constexpr double kExposedPercentile = 0.995;
constexpr double kExposedValue = 0.7;
// The diffuse sphere shares the object's exposure and must not clip at all: its brightest value, noise aside.
constexpr double kLargestSphereValue = 0.9;
// Pixels that the percentiles are taken from, evenly spread over the object.
constexpr size_t kPercentilePixels = 4096;
constexpr double kNearestSynthLight = 1; // widths of the object
constexpr double kWidestSynthView = 60;  // degrees: the camera stays outside the solid
constexpr size_t kMostMaterials = 16;    // 30 patches
constexpr int kMostBounces = 64;
constexpr int kMostBouncingSide = 512; // every pixel keeps its form factors

void require(bool condition, const char* wrong, const char* expected)
{
    if (!condition) {
        throw Error({}, wrong, expected, Error::kUsage);
    }
}

void check(const SynthOptions& o)
{
    require(std::min(o.width, o.height) >= 8, "the picture's side is too small", "8 pixels or more");
    require(o.sphereSize >= 32, "the spheres' pictures are too small", "32 pixels or more");
    require(o.lights >= 1, "there are no lights", "one light or more");
    require(o.capDegrees > 0 && o.capDegrees < 90, "the cap of lights is out of range",
            "more than 0 and less than 90 degrees");
    require(o.lightDistance == 0 || o.lightDistance >= kNearestSynthLight, "the lights are too near",
            "1 width of the object or more");
    require(o.fieldOfView >= 0 && o.fieldOfView <= kWidestSynthView, "the field of view is out of range",
            "0 to 60 degrees");
    require(o.bounces >= 0 && o.bounces <= kMostBounces, "the number of bounces is out of range", "0 to 64");
    require(o.bounces == 0 || std::max(o.width, o.height) <= kMostBouncingSide,
            "the picture's side is too large for light that bounces", "512 pixels or less");
    require(o.noise >= 0 && o.noise < 1, "the noise is out of range", "0 or more and less than 1");
    require(o.patches.size() < kMostMaterials, "there are too many materials", "16 at most");
    require(!o.exposures.empty(), "there are no exposures", "relative times such as 1,0.25");
    require(std::all_of(o.exposures.begin(), o.exposures.end(), [](double t) { return t > 0.0; }),
            "an exposure time is not positive", "relative times such as 1,0.25");
}

BumpySolid solidOf(SynthShape shape)
{
    switch (shape) {
    case SynthShape::sphere:
        return plainSphere();
    case SynthShape::bowl:
        return bowlSolid();
    case SynthShape::bumpy:
        break;
    }
    return bumpySolid();
}

std::vector<uint8_t> labelsOf(const SolidView& view, size_t materials)
{
    std::vector<uint8_t> labels(view.mask.size(), SynthScene::kNoMaterial);
    for (const uint32_t pixel : view.seen) {
        labels[pixel] = static_cast<uint8_t>(patchMaterial(glm::normalize(view.surfacePoint(pixel)), materials));
    }
    return labels;
}

// Half the picture's shorter side is the view's unit.
void placeObject(SynthScene& scene)
{
    glm::dvec2 least(1e9), most(-1e9);
    for (const uint32_t pixel : scene.view.seen) {
        least = glm::min(least, scene.view.planePoint(pixel));
        most = glm::max(most, scene.view.planePoint(pixel));
    }
    scene.middle = glm::dvec3(0.5 * (least + most), 0);
    scene.lightDistance = scene.options.lightDistance * std::max(most.x - least.x, most.y - least.y);
}

bool isLit(const SynthScene& scene, uint32_t pixel, const Light& met)
{
    return dot(scene.view.normals.normals[pixel], met.direction) > 0.0f &&
           (!scene.options.shadows || scene.solid.reachesLight(scene.view.surfacePoint(pixel), met.direction));
}

vec3 lightsRadiance(const SynthScene& scene, uint32_t pixel, const Light& light)
{
    const Light met = lightAt(scene, scene.view.surfacePoint(pixel), light);
    if (!isLit(scene, pixel, met)) {
        return vec3(0);
    }
    const vec3& n = scene.view.normals.normals[pixel];
    vec3 f = evaluate(scene.models[scene.labels[pixel]], n, met.direction, vec3(scene.view.towardsCamera(pixel)));
    return radianceFromBrdf(f, met.irradiance, dot(n, met.direction));
}

// What the solid's nodes send out of a light's; none where no light bounces.
std::vector<glm::dvec3> sentByNodes(const SynthScene& scene, const Light& light)
{
    if (!scene.bouncing) {
        return {};
    }
    const BouncingLight& bouncing = *scene.bouncing;
    std::vector<glm::dvec3> lit;
    for (const SurfaceNode& node : bouncing.nodes) {
        const Light met = lightAt(scene, node.place, light);
        const glm::dvec3 direction(met.direction);
        const double cosine = glm::dot(node.normal, direction);
        const bool reaches = cosine > 0 && (!scene.options.shadows || scene.solid.reachesLight(node.place, direction));
        lit.push_back(reaches ? cosine * glm::dvec3(met.irradiance) : glm::dvec3(0));
    }
    return sentAfter(bouncing.bounces, bouncing.betweenNodes, bouncing.albedos, lit);
}

// Of the view's seen pixel of this number. `sent`: of this light, by the nodes.
vec3 pixelRadiance(const SynthScene& scene, size_t seen, const Light& light, const std::vector<glm::dvec3>& sent)
{
    const uint32_t pixel = scene.view.seen[seen];
    vec3 radiance = lightsRadiance(scene, pixel, light);
    if (scene.bouncing) {
        const glm::dvec3 albedo = scene.bouncing->materialAlbedos[scene.labels[pixel]];
        radiance += vec3(albedo / std::numbers::pi * arriving(scene.bouncing->toPixels[seen], sent));
    }
    return radiance;
}

// Brightest channels of a part of the object's pixels under every light.
std::vector<float> sampledRadiance(const SynthScene& scene)
{
    const size_t pixels = scene.view.seen.size(), lights = scene.lights.size();
    const size_t stride = std::max<size_t>(1, pixels / kPercentilePixels);
    const size_t samples = (pixels + stride - 1) / stride;
    std::vector<float> brightest(samples * lights);
    parallelFor(lights, 1, scene.options.threads, [&](size_t first, size_t last) {
        for (size_t j = first; j < last; ++j) {
            const std::vector<glm::dvec3> sent = sentByNodes(scene, scene.lights[j]);
            for (size_t i = 0; i < samples; ++i) {
                const vec3 radiance = pixelRadiance(scene, i * stride, scene.lights[j], sent);
                brightest[i * lights + j] = max(radiance.x, max(radiance.y, radiance.z));
            }
        }
    });
    return brightest;
}

double brightestSphereRadiance(const SynthScene& scene)
{
    float brightest = 0;
    for (const Light& light : scene.lights) {
        vec3 radiance = light.irradiance * scene.options.sphereReflectance / kPi;
        brightest = max(brightest, max(radiance.x, max(radiance.y, radiance.z)));
    }
    return brightest;
}

Sensor exposedSensor(const SynthScene& scene)
{
    std::vector<float> radiance = sampledRadiance(scene);
    const double bright = quantile(radiance, kExposedPercentile);
    require(bright > 0.0, "the material reflects no light", "a material with some reflectance");
    Sensor sensor;
    sensor.gain = std::min(kExposedValue / bright, kLargestSphereValue / brightestSphereRadiance(scene));
    sensor.noise = scene.options.noise * quantile(radiance, 0.99) * sensor.gain;
    sensor.clips = scene.options.format == SynthFormat::png16;
    sensor.seed = scene.options.seed;
    return sensor;
}

} // namespace

SynthScene makeSynthScene(const SynthOptions& options)
{
    check(options);
    std::vector<BrdfModel> models{parseMaterial(options.material, options.fitsFolder).model};
    for (const std::string& patch : options.patches) {
        models.push_back(parseMaterial(patch, options.fitsFolder).model);
    }
    BumpySolid solid = solidOf(options.shape);
    SolidView view = viewOf(solid, options.width, options.height, options.threads, options.fieldOfView);
    std::vector<uint8_t> labels = labelsOf(view, models.size());
    SynthScene scene{options,
                     std::move(solid),
                     std::move(view),
                     synthLights(options),
                     {},
                     0,
                     std::move(models),
                     std::move(labels),
                     {},
                     {}};
    placeObject(scene);
    if (options.bounces > 0) {
        scene.bouncing = std::make_shared<const BouncingLight>(
            bouncingLight(scene.solid, scene.view, scene.models, options.bounces, options.threads));
    }
    scene.sensor = exposedSensor(scene);
    return scene;
}

Light lightAt(const SynthScene& scene, const glm::dvec3& place, const Light& light)
{
    if (scene.lightDistance <= 0) {
        return light;
    }
    const glm::dvec3 towards = scene.middle + scene.lightDistance * glm::dvec3(light.direction) - place;
    const double share = scene.lightDistance / glm::length(towards);
    return {glm::vec3(glm::normalize(towards)), light.irradiance * static_cast<float>(share * share)};
}

std::vector<uint8_t> litPixels(const SynthScene& scene, const Light& light, int threads)
{
    std::vector<uint8_t> lit(scene.view.mask.size(), 0);
    parallelFor(scene.view.seen.size(), 1024, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            const uint32_t pixel = scene.view.seen[i];
            lit[pixel] = isLit(scene, pixel, lightAt(scene, scene.view.surfacePoint(pixel), light));
        }
    });
    return lit;
}

Image objectRadiance(const SynthScene& scene, const Light& light, int threads)
{
    Image radiance(scene.view.normals.width, scene.view.normals.height, 3);
    const std::vector<glm::dvec3> sent = sentByNodes(scene, light);
    parallelFor(scene.view.seen.size(), 1024, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            const uint32_t pixel = scene.view.seen[i];
            radiance.setRgb(pixel % radiance.width, pixel / radiance.width, pixelRadiance(scene, i, light, sent));
        }
    });
    return radiance;
}

} // namespace nacre
