#include "app/render_scene.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/light_argument.h"
#include "app/size_argument.h"
#include "engine/gpu/texture.h"
#include "engine/scene/brdf_tabulation.h"
#include "engine/scene/environment.h"
#include "engine/scene/error.h"
#include "engine/scene/material_specification.h"

namespace nacre {

namespace {

constexpr int kEnvironmentLights = 256;
constexpr int kMostEnvironmentLights = 100000;

NormalY normalYOf(const RenderArguments& arguments)
{
    if (!arguments.normalY.empty() && arguments.normalY != "gl" && arguments.normalY != "dx") {
        throw Error("", fmt::format("--normal-y {} is not known", arguments.normalY),
                    "gl (green points up) or dx (down)", Error::kUsage);
    }
    return arguments.normalY == "dx" ? NormalY::dx : NormalY::gl;
}

// A named material as a surface without pixels: --onto gives the normals.
Surface surfaceOfMaterial(const RenderArguments& arguments)
{
    const NamedBrdf named = parseMaterial(arguments.material, fitsFolderFrom(arguments.fits));
    const BrdfTable* table = tableOf(named.model);
    Surface surface;
    surface.materials.push_back({named.name, table ? *table : tabulatedBrdf(named.model), {}});
    return surface;
}

void checkMaterialArguments(const RenderArguments& arguments)
{
    if (arguments.surface.empty() == arguments.material.empty()) {
        throw Error("", "one thing to render is needed", "either SURFACE or --material SPEC", Error::kUsage);
    }
    if (!arguments.material.empty() && arguments.onto.empty()) {
        throw Error("", "--material has no shape of its own", "--onto NORMALS or --onto NAME.nacre", Error::kUsage);
    }
}

// The surface to draw: the measured one, or its first material on other normals; fitted into --size where given.
Surface surfaceToDraw(const RenderArguments& arguments, Surface measured, const Context& context)
{
    if (!arguments.onto.empty()) {
        if (measured.materials.empty()) {
            throw Error(arguments.surface, "holds no material", "one to put onto other normals");
        }
        const NormalMap normals = std::filesystem::is_directory(arguments.onto)
                                      ? loadSurface(arguments.onto).normals
                                      : loadNormalMap(arguments.onto, normalYOf(arguments));
        measured = transferredSurface(normals, measured.materials.front());
    }
    if (!arguments.size.empty()) {
        const PictureSize size = sizeFromArgument("--size", arguments.size);
        requirePictureSize(context, size.width, size.height); // before memory for it is asked for
        measured = fittedSurface(measured, size.width, size.height);
    }
    return measured;
}

std::vector<Light> lightsOf(const RenderArguments& arguments, const std::vector<CapturedLight>& captured)
{
    std::vector<Light> lights;
    if (arguments.environment.empty() || !arguments.lights.empty()) {
        lights = lightsFromArguments(arguments.lights, captured);
    }
    if (!arguments.environment.empty()) {
        const Environment environment = loadEnvironment(arguments.environment);
        const auto more = lightsFromEnvironment(environment, arguments.environmentLights.value_or(kEnvironmentLights),
                                                glm::radians(arguments.environmentTurn.value_or(0.0f)));
        lights.insert(lights.end(), more.begin(), more.end());
    }
    return lights;
}

// The direction towards the viewer; it has to see the front of something.
glm::vec3 viewOf(const RenderArguments& arguments)
{
    if (arguments.view.empty()) {
        return {0, 0, 1};
    }
    const std::vector<float> numbers = numbersFromArgument(arguments.view);
    const glm::dvec3 view = numbers.size() == 3 ? glm::dvec3(numbers[0], numbers[1], numbers[2]) : glm::dvec3(0);
    if (!(view.z > 0)) {
        throw Error("", fmt::format("--view {} is no direction to see the front from", arguments.view),
                    "x,y,z towards the viewer, z above 0", Error::kUsage);
    }
    return glm::vec3(glm::normalize(view));
}

} // namespace

void checkSceneArguments(const RenderArguments& arguments)
{
    normalYOf(arguments);
    checkMaterialArguments(arguments);
    viewOf(arguments);
    const int count = arguments.environmentLights.value_or(kEnvironmentLights);
    if (count < 1 || count > kMostEnvironmentLights) {
        throw Error("", fmt::format("--environment-lights {} is out of range", count),
                    fmt::format("1 to {}", kMostEnvironmentLights), Error::kUsage);
    }
    if (!arguments.normalY.empty() && arguments.onto.empty()) {
        throw Error("", "--normal-y has nothing to turn", "--onto with it", Error::kUsage);
    }
}

Scene sceneFromArguments(const RenderArguments& arguments, const Context& context)
{
    Surface measured = arguments.material.empty() ? loadSurface(arguments.surface) : surfaceOfMaterial(arguments);
    Scene scene;
    scene.lights = lightsOf(arguments, measured.lights);
    scene.view = viewOf(arguments);
    scene.surface = surfaceToDraw(arguments, std::move(measured), context);
    return scene;
}

void noteLightsBeyondTables(const Scene& scene)
{
    for (const Material& material : scene.surface.materials) {
        const TableDomain& domain = material.table.domain;
        const auto beyond = std::count_if(scene.lights.begin(), scene.lights.end(), [&](const Light& light) {
            constexpr float kTolerance = 0.001f; // radians
            const float thetaD = halfDifferenceFromDirections(scene.view, light.direction, scene.view).thetaD;
            return domain.coordinates == kHalfDifference && thetaD > domain.thetaDMax + kTolerance;
        });
        if (beyond > 0) {
            fmt::print(stderr,
                       "nacre: note: the table of '{}' spans lights up to {:.0f} degrees from the view; of {} given {} "
                       "lie beyond, there its last values are used\n",
                       material.name, 2 * glm::degrees(domain.thetaDMax), scene.lights.size(), beyond);
        }
    }
}

} // namespace nacre
