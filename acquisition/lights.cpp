#include "acquisition/lights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "acquisition/mirror_sphere.h"
#include "engine/scene/error.h"
#include "engine/scene/measures.h"
#include "engine/scene/parallel_for.h"
#include "shared/glsl.h"

namespace nacre {

namespace {

// Beyond it, an error of 1 % in the photographs can turn the normal by more than it is long.
constexpr double kWorstCondition = 100;

Circle outlineOf(const SpherePhotographs& sphere, const Image& photograph)
{
    if (sphere.circle) {
        return *sphere.circle;
    }
    const std::vector<uint8_t> mask = loadMask(sphere.maskFile, photograph.width, photograph.height);
    return fitCircle(mask, photograph.width, photograph.height, sphere.maskFile);
}

// Longest exposure for shading, shortest for a highlight.
const Exposure& longest(const Photograph& photograph)
{
    return *std::max_element(photograph.exposures.begin(), photograph.exposures.end(),
                             [](const Exposure& a, const Exposure& b) { return a.seconds < b.seconds; });
}

const Exposure& shortest(const Photograph& photograph)
{
    return *std::min_element(photograph.exposures.begin(), photograph.exposures.end(),
                             [](const Exposure& a, const Exposure& b) { return a.seconds < b.seconds; });
}

std::vector<Light> directionsFromMirror(const Capture& capture, int threads)
{
    const SpherePhotographs& sphere = *capture.mirrorSphere;
    std::vector<Light> lights(sphere.photographs.size());
    const Circle outline = outlineOf(sphere, loadPhotograph(shortest(sphere.photographs.front()).file, capture.curve));
    parallelFor(lights.size(), 1, threads, [&](size_t first, size_t) {
        const std::filesystem::path& file = shortest(sphere.photographs[first]).file;
        const Image image = loadPhotograph(file, capture.curve);
        lights[first].direction = lightFromHighlight(findHighlight(image, outline, file), outline);
    });
    return lights;
}

// One factor for all lights and channels, so that colour and unevenness stay.
void scaleIrradiances(Rig& rig, const std::optional<glm::vec3>& reflectance)
{
    double sum = 0;
    for (const Light& light : rig.lights) {
        sum += light.irradiance.x + light.irradiance.y + light.irradiance.z;
    }
    const glm::vec3 factor = reflectance ? kPi / *reflectance : glm::vec3(3 * rig.lights.size() / sum);
    for (Light& light : rig.lights) {
        light.irradiance *= factor;
    }
}

void addIrradiances(const Capture& capture, const CalibrationOptions& options, Rig& rig)
{
    const SpherePhotographs& sphere = *capture.diffuseSphere;
    const Circle outline = outlineOf(sphere, loadPhotograph(longest(sphere.photographs.front()).file, capture.curve));
    rig.shadingDisagreement.resize(rig.lights.size());
    parallelFor(rig.lights.size(), 1, options.threads, [&](size_t i, size_t) {
        const Exposure& exposure = longest(sphere.photographs[i]);
        const Image image = loadPhotograph(exposure.file, capture.curve);
        const DiffuseSphereReading reading =
            readDiffuseSphere(image, outline, rig.lights[i].direction, exposure.file, options.rules);
        if (!capture.irradianceGiven) {
            rig.lights[i].irradiance = reading.radiance / static_cast<float>(exposure.seconds);
        }
        rig.shadingDisagreement[i] =
            static_cast<float>(degreesBetween(reading.shadingDirection, rig.lights[i].direction));
    });
    if (!capture.irradianceGiven) {
        scaleIrradiances(rig, options.sphereReflectance);
        rig.irradiancesFrom = sphere.source.string();
        rig.absolute = options.sphereReflectance.has_value();
    }
}

void checkLights(const Capture& capture, Rig& rig)
{
    if (rig.lights.size() < 3) {
        throw Error(capture.folder, fmt::format("has {} usable light(s)", rig.lights.size()),
                    "at least three lights that do not lie in one plane");
    }
    rig.condition = conditionOf(rig.lights);
    if (!(rig.condition < kWorstCondition)) {
        throw Error(
            capture.folder,
            fmt::format("its lights lie in one plane with the object (condition number {:.3g})", rig.condition),
            fmt::format("directions that span space (below {:.0f}; well-spread lights have 1 to 10)", kWorstCondition));
    }
}

} // namespace

double conditionOf(const std::vector<Light>& lights)
{
    Eigen::MatrixXd directions(lights.size(), 3);
    for (size_t i = 0; i < lights.size(); ++i) {
        const glm::vec3& d = lights[i].direction;
        directions.row(static_cast<Eigen::Index>(i)) << d.x, d.y, d.z;
    }
    const Eigen::VectorXd singular = directions.jacobiSvd().singularValues();
    const double smallest = singular.size() < 3 ? 0 : singular(2);
    return smallest > 0 ? singular(0) / smallest : std::numeric_limits<double>::infinity();
}

Rig calibrateLights(const Capture& capture, const CalibrationOptions& options)
{
    Rig rig;
    rig.irradiancesFrom = capture.irradianceGiven ? capture.lightsSource : "not known: 1 for every light";
    if (!capture.lights.empty()) {
        rig.lights = capture.lights;
        rig.directionsFrom = capture.lightsSource;
    } else if (capture.mirrorSphere) {
        rig.lights = directionsFromMirror(capture, options.threads);
        rig.directionsFrom = capture.mirrorSphere->source.string();
    } else {
        throw Error(capture.folder, "says nothing of its lights",
                    "light directions, a mirror sphere (--mirror-sphere DIR) or a rig (--rig FILE)");
    }
    if (capture.diffuseSphere) {
        addIrradiances(capture, options, rig);
    }
    checkLights(capture, rig);
    return rig;
}

} // namespace nacre
