#include "engine/loading/render_scene.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/files/error.h"
#include "engine/gpu/texture.h"
#include "engine/lights/environment.h"
#include "engine/loading/cast_shadows.h"
#include "engine/loading/light_argument.h"
#include "engine/loading/material_argument.h"
#include "engine/loading/rig_argument.h"
#include "engine/loading/size_argument.h"
#include "engine/scene/coverage.h"
#include "engine/scene/scene_names.h"
#include "engine/scene/scene_residual.h"
#include "engine/target/mesh_file.h"

namespace nacre {

namespace {

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
    Surface surface;
    surface.materials.push_back(materialFromArgument(arguments.material, arguments.fits));
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

// The normals of --onto, dressed in the material.
Surface surfaceOnto(const RenderArguments& arguments, const Material& material)
{
    const std::filesystem::path& onto = arguments.onto;
    if (onto.string().rfind("make:", 0) == 0 || isMeshFile(onto)) {
        throw Error(onto, "is no normal map yet",
                    fmt::format("T.nacre of nacre target {} -o T.nacre, or nacre transfer", onto.string()),
                    Error::kUsage);
    }
    if (!std::filesystem::exists(onto)) {
        throw Error(onto, "does not exist", "a NAME.nacre or a picture of normals");
    }
    return std::filesystem::is_directory(onto)
               ? transferredSurface(loadSurface(onto), material)
               : transferredSurface(loadNormalMap(onto, normalYOf(arguments)), material);
}

// The surface to draw: the measured one, or its first material on other normals; fitted into --size where given.
Surface surfaceToDraw(const RenderArguments& arguments, Surface measured, const Context& context)
{
    if (!arguments.onto.empty()) {
        if (measured.materials.empty()) {
            throw Error(arguments.surface, "holds no material", "one to put onto other normals");
        }
        measured = surfaceOnto(arguments, measured.materials.front());
    } else if (measured.materials.empty()) {
        throw Error(
            arguments.surface, "is a target without a material",
            fmt::format("--material SPEC --onto {}, or another surface with --onto", arguments.surface.string()));
    }
    if (arguments.shadows.value_or(false)) { // before pixels are repeated, which would make stairs of the height
        castShadows(measured, arguments.onto.empty() ? arguments.surface : arguments.onto);
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
    const bool hasOthers = !arguments.environment.empty() || !arguments.rig.empty();
    if (!hasOthers || !arguments.lights.empty()) {
        lights = lightsFromArguments(arguments.lights, captured);
    }
    if (!arguments.rig.empty()) {
        const std::vector<Light> more = rigFromArgument(arguments.rig).lights;
        lights.insert(lights.end(), more.begin(), more.end());
    }
    if (!arguments.environment.empty()) {
        const Environment environment = loadEnvironment(arguments.environment);
        const auto more = lightsFromEnvironment(environment, arguments.environmentLights.value_or(kEnvironmentLights),
                                                glm::radians(arguments.environmentTurn.value_or(0.0f)));
        lights.insert(lights.end(), more.begin(), more.end());
    }
    return lights;
}

Surface measuredFromArguments(const RenderArguments& arguments)
{
    return arguments.material.empty() ? loadSurface(arguments.surface) : surfaceOfMaterial(arguments);
}

// The surface to draw, which keeps the captured lights of the measured one.
Surface drawnFromArguments(const RenderArguments& arguments, Surface measured, const Context& context)
{
    std::vector<CapturedLight> captured = measured.lights;
    Surface surface = surfaceToDraw(arguments, std::move(measured), context);
    surface.lights = std::move(captured);
    return surface;
}

// The layer is of the captured surface from the front, and knows the lights about the captured ones.
void noteResidual(const Scene& scene, bool wasMeasured)
{
    if (!wasMeasured) {
        return;
    }
    if (!hasResidualFrom(scene.surface, scene.view)) {
        fmt::print(stderr, "nacre: note: the residual layer is left out: it belongs to the surface's {}\n",
                   scene.surface.residual.empty() ? "own shape" : "view from the front");
        return;
    }
    const size_t beyond = lightsBeyondResidual(scene.surface.residual, scene.lights);
    if (beyond > 0) {
        fmt::print(stderr,
                   "nacre: note: the residual layer fades out under {} of {} light{}, away from the captured ones\n",
                   beyond, scene.lights.size(), scene.lights.size() == 1 ? "" : "s");
    }
}

std::string percentage(double share)
{
    return share < 0.001 ? "below 0.1 %" : fmt::format("{:.1f} %", 100 * share);
}

} // namespace

void checkSceneArguments(const RenderArguments& arguments)
{
    normalYOf(arguments);
    checkMaterialArguments(arguments);
    viewFromArguments(arguments);
    const int count = arguments.environmentLights.value_or(kEnvironmentLights);
    if (count < 1 || count > kMostEnvironmentLights) {
        throw Error("", fmt::format("--environment-lights {} is out of range", count),
                    fmt::format("1 to {}", kMostEnvironmentLights), Error::kUsage);
    }
    if (!arguments.normalY.empty() && arguments.onto.empty()) {
        throw Error("", "--normal-y has nothing to turn", "--onto with it", Error::kUsage);
    }
}

glm::vec3 viewFromArguments(const RenderArguments& arguments)
{
    if (arguments.view.empty()) {
        return {0, 0, 1};
    }
    const std::vector<float> numbers = numbersFromText(arguments.view);
    const glm::dvec3 view = numbers.size() == 3 ? glm::dvec3(numbers[0], numbers[1], numbers[2]) : glm::dvec3(0);
    if (!(view.z > 0)) {
        throw Error("", fmt::format("--view {} is no direction to see the front from", arguments.view),
                    "x,y,z towards the viewer, z above 0", Error::kUsage);
    }
    return glm::vec3(glm::normalize(view));
}

Surface surfaceFromArguments(const RenderArguments& arguments, const Context& context)
{
    return drawnFromArguments(arguments, measuredFromArguments(arguments), context);
}

Scene sceneFromArguments(const RenderArguments& arguments, const Context& context)
{
    Scene scene;
    scene.view = viewFromArguments(arguments);
    Surface measured = measuredFromArguments(arguments);
    const bool hasResidual = !measured.residual.empty();
    const ResidualUse use = residualUseFromName(arguments.residual);
    scene.surface = drawnFromArguments(arguments, std::move(measured), context);
    requireResidual(scene.surface, scene.view, use);
    scene.lights = lightsOf(arguments, scene.surface.lights);
    if (!arguments.quiet && use != ResidualUse::off) {
        noteResidual(scene, hasResidual);
    }
    return scene;
}

void noteUnmeasured(const Scene& scene)
{
    const UnmeasuredShare share = unmeasuredShare(scene);
    if (share.pixels > 0) {
        fmt::print(stderr,
                   "nacre: note: {} of the lit pixels ({} of their light by n.l) ask for directions that were not "
                   "measured: the nearest that were answer, --show coverage hatches them\n",
                   percentage(share.pixels), percentage(share.light));
    }
}

} // namespace nacre
