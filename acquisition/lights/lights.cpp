#include "acquisition/lights/lights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "acquisition/capture/capture_maps.h"
#include "acquisition/capture/exposure_merge.h"
#include "acquisition/lights/mirror_rays.h"
#include "acquisition/lights/mirror_sphere.h"
#include "acquisition/lights/sphere_in_picture.h"
#include "acquisition/lights/sphere_outline.h"
#include "acquisition/near_field/near_field.h"
#include "engine/files/error.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"
#include "shared/glsl.h"

namespace nacre {

namespace {

constexpr size_t kFewestTurnLights = 3;
constexpr double kLargestSphereTurn = 2; // degrees; real spheres: docs/limitations.md
constexpr double kTurnSigmas = 3;

} // namespace

CommonTurn commonTurn(const std::vector<glm::vec3>& mirror, const std::vector<glm::vec3>& shading)
{
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    double squares = 0;
    for (size_t i = 0; i < mirror.size(); ++i) {
        const Eigen::Vector3d l(mirror[i].x, mirror[i].y, mirror[i].z), s(shading[i].x, shading[i].y, shading[i].z);
        Eigen::Matrix3d cross; // w x l as a matrix times w
        cross << 0, l.z(), -l.y(), -l.z(), 0, l.x(), l.y(), -l.x(), 0;
        products += cross.transpose() * cross;
        right += cross.transpose() * (s - l);
        squares += (s - l).squaredNorm();
    }
    const Eigen::Vector3d turn = products.completeOrthogonalDecomposition().solve(right);
    const double left = std::max(0.0, squares - turn.dot(right));
    const double freedom = std::max(1.0, 2.0 * static_cast<double>(mirror.size()) - 3);
    // About x and y alone: lights around the view say little of a turn about it, and it harms least.
    const double error = std::sqrt(
        left / freedom * products.completeOrthogonalDecomposition().pseudoInverse().topLeftCorner<2, 2>().trace());
    return {glm::degrees(turn.head<2>().norm()), glm::degrees(error)};
}

std::optional<std::string> sphereWarning(const std::vector<glm::vec3>& mirror, const std::vector<glm::vec3>& shading)
{
    if (mirror.size() < kFewestTurnLights || mirror.size() != shading.size()) {
        return {};
    }
    const CommonTurn turn = commonTurn(mirror, shading);
    if (turn.degrees < kLargestSphereTurn || turn.degrees < kTurnSigmas * turn.standardError) {
        return {};
    }
    return fmt::format("the diffuse sphere's shading puts all lights {:.1f} degrees to one side of where they are said "
                       "to be; check the outlines (masks) of the spheres",
                       turn.degrees);
}

namespace {

// Beyond it, an error of 1 % in the photographs can turn the normal by more than it is long.
constexpr double kWorstLightCondition = 100;
// Of photographs against the model, and what it may make of the normals in degrees: as much as gloss does to methods
// that do not know it.
constexpr double kUsualError = 0.01;
constexpr double kLargestError = 4;
// Three observations explain any three values; of the four that seven lights leave beside them, a shadow and a
// highlight are no majority.
constexpr size_t kFewestForOutliers = 7;

Circle outlineOf(const SpherePhotographs& sphere, const Capture& capture)
{
    if (sphere.circle) {
        return *sphere.circle;
    }
    if (sphere.inPicture) {
        return circleInPicture(*sphere.inPicture, capture);
    }
    const ImageHeader header = readImageHeader(sphere.maskFile);
    const std::vector<uint8_t> mask = loadMask(sphere.maskFile, header.width, header.height).inside;
    return fitCircle(mask, header.width, header.height, sphere.maskFile);
}

std::vector<Circle> outlinesOf(const SpherePhotographs& sphere, const Capture& capture)
{
    std::vector<Circle> outlines{outlineOf(sphere, capture)};
    for (const SphereInPicture& beside : sphere.beside) {
        outlines.push_back(circleInPicture(beside, capture));
    }
    return outlines;
}

// What is to be read around the spheres: their outlines, and a little for what grows out of them.
FileWindow boxAround(const std::vector<Circle>& outlines)
{
    constexpr double kMargin = 2; // pixels
    double x0 = outlines[0].x, y0 = outlines[0].y, x1 = x0, y1 = y0;
    for (const Circle& c : outlines) {
        const double reach = c.radius + kMargin;
        x0 = std::min(x0, c.x - reach), x1 = std::max(x1, c.x + reach);
        y0 = std::min(y0, c.y - reach), y1 = std::max(y1, c.y + reach);
    }
    const int x = static_cast<int>(std::floor(x0)), y = static_cast<int>(std::floor(y0));
    return {x, y, static_cast<int>(std::ceil(x1)) - x, static_cast<int>(std::ceil(y1)) - y};
}

Circle within(const MergedPhotograph& part, const Circle& outline)
{
    return {outline.x - part.x, outline.y - part.y, outline.radius};
}

Highlight highlightOn(const MergedPhotograph& part, const Circle& outline, const std::filesystem::path& file)
{
    Highlight highlight = findHighlight(part.radiance, within(part, outline), file);
    highlight.x += part.x;
    highlight.y += part.y;
    return highlight;
}

// From where the highlight lies on a sphere that stands beside the object, in the middle of which all else is.
MirrorRay rayOf(const Highlight& highlight, const Circle& outline, const SpherePhotographs& sphere,
                const Capture& capture, const ObjectExtent& extent)
{
    MirrorRay ray{glm::dvec3(0), lightFromHighlight(highlight, outline)};
    if (sphere.inPicture) {
        const FileWindow& window = capture.window;
        const glm::dvec2 at =
            (glm::dvec2(highlight.x, highlight.y) - glm::dvec2(window.x, window.y)) / static_cast<double>(window.box);
        const double z = sphereNormal(outline, highlight.x, highlight.y).z * outline.radius / window.box;
        ray.from = glm::dvec3(at.x - extent.middle.x, extent.middle.y - at.y, z) / extent.width;
    }
    return ray;
}

MirrorLights lightsFromMirror(const Capture& capture, int threads)
{
    const SpherePhotographs& sphere = *capture.mirrorSphere;
    const std::vector<Circle> outlines = outlinesOf(sphere, capture);
    const FileWindow box = boxAround(outlines);
    const ObjectExtent extent = extentOf(capture);
    std::vector<std::vector<MirrorRay>> rays(sphere.photographs.size());
    parallelFor(rays.size(), 1, threads, [&](size_t first, size_t) {
        const std::filesystem::path& file = sphere.photographs[first].exposures.front().file;
        const MergedPhotograph merged = loadMerged(sphere.photographs[first], capture, box);
        for (const Circle& outline : outlines) {
            rays[first].push_back(rayOf(highlightOn(merged, outline, file), outline, sphere, capture, extent));
        }
    });
    return lightsOfRays(rays, sphere.inPicture ? capture.lightDistance : std::numeric_limits<double>::infinity());
}

void addMirrorLights(const Capture& capture, int threads, Rig& rig)
{
    MirrorLights found = lightsFromMirror(capture, threads);
    rig.lights = std::move(found.lights);
    rig.directionsFrom = capture.mirrorSphere->source.string() + (found.placed.empty() ? "" : ", " + found.placed);
    if (found.apart > kLargestSphereTurn) {
        rig.warnings.push_back({FindingCode::spheresDisagree,
                                fmt::format("the mirror spheres' rays pass the lights by {:.1f} degrees; check the "
                                            "outlines (masks) of the spheres",
                                            found.apart)});
    }
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
    const Circle outline = outlineOf(sphere, capture);
    const FileWindow box = boxAround({outline});
    std::vector<DiffuseSphereReading> readings(rig.lights.size());
    parallelFor(rig.lights.size(), 1, options.threads, [&](size_t i, size_t) {
        const std::filesystem::path& file = sphere.photographs[i].exposures.front().file;
        const MergedPhotograph merged = loadMerged(sphere.photographs[i], capture, box);
        readings[i] = readDiffuseSphere(merged.radiance, within(merged, outline), rig.lights[i].direction, file,
                                        options.rules, merged.saturated);
    });
    shareOffset(readings);
    rig.shadingOffset = readings.front().offset;
    std::vector<glm::vec3> known, shading;
    for (size_t i = 0; i < readings.size(); ++i) {
        rig.shadingDisagreement.push_back(
            static_cast<float>(degreesBetween(readings[i].shadingDirection, rig.lights[i].direction)));
        known.push_back(rig.lights[i].direction);
        shading.push_back(readings[i].shadingDirection);
    }
    if (const auto warning = sphereWarning(known, shading)) {
        rig.warnings.push_back({FindingCode::spheresDisagree, *warning});
    }
    if (!capture.irradianceGiven) {
        for (size_t i = 0; i < readings.size(); ++i) {
            rig.lights[i].irradiance = readings[i].radiance;
        }
        scaleIrradiances(rig, options.sphereReflectance);
        rig.irradiancesFrom = sphere.source.string();
        rig.absolute = options.sphereReflectance.has_value();
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

std::vector<Finding> warningsOf(const std::vector<Light>& lights)
{
    std::vector<Finding> warnings;
    const double condition = conditionOf(lights), degrees = glm::degrees(std::atan(kUsualError * condition));
    if (degrees >= kLargestError) {
        warnings.push_back(
            {FindingCode::lightsIllPlaced,
             fmt::format("the lights lie nearly in one plane or close together (condition {:.0f}): an error of "
                         "{:.0f} % in the photographs turns normals by up to {:.0f} degrees",
                         condition, 100 * kUsualError, degrees)});
    }
    if (lights.size() < kFewestForOutliers) {
        warnings.push_back(
            {FindingCode::fewLights, fmt::format("with {} lights shadows and highlights cannot be told from shading; "
                                                 "{} or more can",
                                                 lights.size(), kFewestForOutliers)});
    }
    return warnings;
}

double requireSpanningLights(const std::vector<Light>& lights, const std::filesystem::path& source)
{
    if (lights.size() < 3) {
        throw Error(source, fmt::format("has {} usable light(s)", lights.size()),
                    "at least three lights that do not lie in one plane");
    }
    if (std::all_of(lights.begin(), lights.end(), [](const Light& light) { return light.direction.z < 0; })) {
        throw Error(source, "has all its lights behind the object: their z is below 0", "z towards the camera");
    }
    const double condition = conditionOf(lights);
    if (!(condition < kWorstLightCondition)) {
        throw Error(source,
                    fmt::format("its lights lie in one plane with the object (condition number {:.3g})", condition),
                    fmt::format("directions that span space (below {:.0f}; well-spread lights have 1 to 10)",
                                kWorstLightCondition));
    }
    return condition;
}

Rig calibrateLights(const Capture& capture, const CalibrationOptions& options)
{
    Rig rig;
    rig.irradiancesFrom = capture.irradianceGiven ? capture.lightsSource : "not known: 1 for every light";
    if (!capture.lights.empty()) {
        rig.lights = capture.lights;
        rig.directionsFrom = capture.lightsSource + (capture.lightsOrder.empty() ? "" : ", " + capture.lightsOrder);
    } else if (capture.mirrorSphere) {
        addMirrorLights(capture, options.threads, rig);
    } else {
        throw Error(capture.folder, "says nothing of its lights",
                    "light directions, photographs of a mirror sphere, or a rig");
    }
    if (capture.diffuseSphere) {
        addIrradiances(capture, options, rig);
    }
    rig.condition = requireSpanningLights(rig.lights, capture.folder);
    return rig;
}

} // namespace nacre
