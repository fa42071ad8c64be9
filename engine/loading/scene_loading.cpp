#include "engine/loading/scene_loading.h"

#include <charconv>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/files/error.h"
#include "engine/files/text_files.h"
#include "engine/gpu/texture.h"
#include "engine/lights/light_files.h"
#include "engine/lights/light_rigs.h"
#include "engine/materials/material_specification.h"
#include "engine/scene/coverage.h"
#include "engine/scene/scene_residual.h"
#include "engine/surface/height_from_normals.h"
#include "engine/surface/object_places.h"
#include "engine/target/mesh_file.h"
#include "engine/target/mesh_raster.h"
#include "engine/target/relief.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

LightRig rigOfFile(const fs::path& file)
{
    const std::string extension = lowerExtension(file);
    if (extension == ".exr" || extension == ".hdr") {
        return {file.stem().string(), lightsFromEnvironment(loadEnvironment(file), kEnvironmentLights)};
    }
    LightRig rig{file.stem().string(), loadLightFile(file).lights};
    if (rig.lights.empty()) {
        throw Error(file, "holds no light", "lights as nacre calibrate writes them");
    }
    return rig;
}

LightRig lightOfRig(const fs::path& file, const std::string& digits)
{
    LightRig rig = rigOfFile(file);
    size_t number = 0;
    const char* end = digits.data() + digits.size();
    const auto [next, error] = std::from_chars(digits.data(), end, number);
    if (error != std::errc() || next != end || number < 1 || number > rig.lights.size()) {
        throw Error(file, fmt::format("has no light #{}", digits), fmt::format("#1 to #{}", rig.lights.size()),
                    Error::kUsage);
    }
    return {fmt::format("{}-{}", rig.name, number), {rig.lights[number - 1]}};
}

constexpr int kMostEnvironmentLights = 100000;

constexpr PictureSize kGeneratedSize{512, 512}; // unless the scene has another: a statue takes a second or two

// The normals of `onto`, dressed in the material.
Surface surfaceOnto(const SceneDescription& scene, const SceneInputs& inputs, const Material& material)
{
    const std::filesystem::path& onto = scene.onto;
    if (isGenerated(onto) && inputs.makeShape) {
        return transferredSurface(inputs.makeShape(onto.string(), scene.size.value_or(kGeneratedSize)), material);
    }
    if (!std::filesystem::exists(onto)) {
        throw Error(onto, "does not exist", "a NAME.nacre or a picture of normals");
    }
    return std::filesystem::is_directory(onto)
               ? transferredSurface(loadSurface(onto), material)
               : transferredSurface(loadNormalMap(onto, scene.normalY.value_or(NormalY::gl)), material);
}

// The surface as measured; a named material as a surface without pixels.
Surface loadMeasured(const SceneDescription& scene, const SceneInputs& inputs)
{
    if (scene.material.empty()) {
        return loadSurface(scene.surface);
    }
    Surface surface;
    surface.materials.push_back(loadMaterial(scene.material, fitsFolderFrom(inputs.fits)));
    return surface;
}

MeshViewOptions meshOptionsOf(const SceneDescription& scene, const Mesh& mesh)
{
    MeshViewOptions options{.turn = scene.turn};
    if (mesh.front) {
        options.width = mesh.front->normals.width;
        options.height = mesh.front->normals.height;
    }
    if (scene.size) {
        options.width = scene.size->width;
        options.height = scene.size->height;
    }
    return options;
}

void requireMaterial(const Surface& measured, const fs::path& file)
{
    if (measured.materials.empty()) {
        throw Error(file, "holds no material", "one to put onto other normals");
    }
}

// Its pixels.
std::shared_ptr<const Surface> frontOf(const Surface& surface)
{
    auto front = std::make_shared<Surface>(surface);
    front->materials.clear();
    return front;
}

// The measured one, or its first material on other normals; fitted into the size where given.
LoadedSurface drawnSurfaceOf(const SceneDescription& scene, const SceneInputs& inputs, Surface measured,
                             const Context& context, bool canTurn)
{
    std::vector<CapturedLight> captured = measured.lights;
    if (isMeshFile(scene.onto)) {
        requireMaterial(measured, scene.surface);
        Surface dressed;
        dressed.materials = {std::move(measured.materials.front())};
        dressed.lights = std::move(captured);
        return {std::move(dressed), std::make_shared<const Mesh>(loadMesh(scene.onto))};
    }
    if (!scene.onto.empty()) {
        requireMaterial(measured, scene.surface);
        measured = surfaceOnto(scene, inputs, measured.materials.front());
    } else if (measured.materials.empty()) {
        throw Error(scene.surface, "is a target without a material",
                    "a material to put onto it, or another surface's onto it");
    }
    if (scene.shadows.value_or(
            measured.castsShadows)) { // before pixels are repeated, which would make stairs of the height
        castShadows(measured, scene.onto.empty() ? scene.surface : scene.onto);
    }
    std::shared_ptr<const Mesh> relief;
    const bool hasHeight = !measured.height.values.empty();
    const bool isTurned = scene.turn != Turn() || scene.motion == LightMotion::object;
    if (isTurned && !hasHeight) {
        throw Error(scene.onto.empty() ? scene.surface : scene.onto, "has no height, and cannot be turned",
                    "an acquired surface, or a mesh to put the material onto (.obj, .ply, .gltf, .glb, .stl)");
    }
    if (hasHeight && (canTurn || isTurned)) {
        relief = std::make_shared<const Mesh>(reliefMesh(frontOf(measured)));
    }
    if (scene.size) {
        requirePictureSize(context, scene.size->width, scene.size->height); // before memory for it is asked for
        measured = fittedSurface(measured, scene.size->width, scene.size->height);
    }
    measured.lights = std::move(captured);
    return {std::move(measured), std::move(relief)};
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

} // namespace

LightRig rigFromArgument(const std::string& text)
{
    if (fs::is_regular_file(text)) {
        return rigOfFile(text);
    }
    const size_t mark = text.rfind('#');
    if (mark != std::string::npos && fs::is_regular_file(text.substr(0, mark))) {
        return lightOfRig(text.substr(0, mark), text.substr(mark + 1));
    }
    if (fs::path(text).has_extension()) {
        throw Error(text, "does not exist", fmt::format("a file of lights, or one of {}", fmt::join(rigNames(), ", ")));
    }
    return {text, lightsOfRig(text)};
}

void requireConsistent(const SceneDescription& scene)
{
    if (scene.surface.empty() == scene.material.empty()) {
        throw Error("", "one thing to render is needed", "either a surface or a material", Error::kUsage);
    }
    if (!scene.material.empty() && scene.onto.empty()) {
        throw Error("", "a material has no shape of its own", "normals or a NAME.nacre to put it onto", Error::kUsage);
    }
    const int count = scene.environmentLights.value_or(kEnvironmentLights);
    if (count < 1 || count > kMostEnvironmentLights) {
        throw Error("", fmt::format("{} environment-lights are out of range", count),
                    fmt::format("1 to {}", kMostEnvironmentLights), Error::kUsage);
    }
    if (scene.normalY && scene.onto.empty()) {
        throw Error("", "normal-y has nothing to turn", "other normals to put the material onto", Error::kUsage);
    }
}

void castShadows(Surface& surface, const std::filesystem::path& source)
{
    if (surface.height.values.empty()) {
        if (!std::filesystem::is_directory(source)) {
            throw Error(source, "has no height that could cast shadows",
                        "a NAME.nacre, which nacre target makes of normals, or no shadows", Error::kUsage);
        }
        IntegratedHeight integrated = heightFromNormals(surface.normals);
        surface.height = std::move(integrated.height);
        fmt::print(stderr, "nacre: note: {} has no height: shadows are cast by one integrated from its normals{}\n",
                   source.string(),
                   integrated.pieces > 1
                       ? fmt::format(", in {} pieces whose heights against each other are not known", integrated.pieces)
                       : "");
    }
    surface.horizon = horizonMap(surface.normals, heightInPicture(surface));
}

LoadedSurface loadSurfaceOrMesh(const SceneDescription& scene, const SceneInputs& inputs, const Context& context,
                                bool canTurn)
{
    return drawnSurfaceOf(scene, inputs, loadMeasured(scene, inputs), context, canTurn);
}

std::unique_ptr<MeshRaster> meshRasterFor(const Context& context, std::shared_ptr<const Mesh> mesh,
                                          const SceneDescription& scene)
{
    const MeshViewOptions options = meshOptionsOf(scene, *mesh);
    return std::make_unique<MeshRaster>(context, std::move(mesh), options.width, options.height);
}

namespace {

// All but what does not lie in pixels, fitted into the scene's size.
void takePixels(const Surface& from, const SceneDescription& scene, Surface& surface)
{
    Surface pixels = scene.size ? fittedSurface(from, scene.size->width, scene.size->height) : from;
    pixels.materials = std::move(surface.materials);
    pixels.lights = std::move(surface.lights);
    surface = std::move(pixels);
}

} // namespace

void drawMesh(MeshRaster& raster, const SceneDescription& scene, Surface& surface, bool isCoarse)
{
    const Mesh& mesh = *raster.mesh();
    if (mesh.front && scene.turn == Turn()) {
        takePixels(*mesh.front, scene, surface);
        return;
    }
    Surface seen = raster.draw(fittedView(mesh, meshOptionsOf(scene, mesh)), isCoarse);
    if (mesh.front) {
        seen.castsShadows = mesh.front->castsShadows;
        takePixels(seen, {}, surface);
        if (!isCoarse && scene.shadows.value_or(surface.castsShadows)) {
            castShadows(surface, scene.surface);
        }
        return;
    }
    surface.labels.assign(seen.labels.size(), Surface::kNoMaterial);
    for (size_t i = 0; i < seen.labels.size(); ++i) {
        surface.labels[i] = seen.normals.confidence[i] > 0 ? 0 : Surface::kNoMaterial;
    }
    surface.normals = std::move(seen.normals);
    surface.height = std::move(seen.height);
    surface.horizon = {};
    if (!isCoarse && scene.shadows.value_or(false)) {
        castShadows(surface, scene.onto);
    }
}

std::shared_ptr<const PixelTextures> drawMeshPixels(MeshRaster& raster, const SceneDescription& scene,
                                                    const std::optional<Zoom>& zoom)
{
    const MeshView view = fittedView(*raster.mesh(), meshOptionsOf(scene, *raster.mesh()));
    return raster.drawPixels(zoom ? zoomedView(view, *zoom) : view);
}

namespace {

void drawMeshOnce(const SceneDescription& scene, const Context& context, LoadedSurface& loaded)
{
    if (loaded.mesh) {
        drawMesh(*meshRasterFor(context, loaded.mesh, scene), scene, loaded.surface);
    }
}

} // namespace

Surface loadDrawnSurface(const SceneDescription& scene, const SceneInputs& inputs, const Context& context)
{
    LoadedSurface loaded = loadSurfaceOrMesh(scene, inputs, context, false);
    drawMeshOnce(scene, context, loaded);
    return std::move(loaded.surface);
}

std::vector<Light> lightsOfScene(const SceneDescription& scene, const Environment* environment,
                                 std::span<const CapturedLight> captured)
{
    std::vector<Light> lights = lightsOf(scene.lights, captured);
    const auto append = [&](const std::vector<Light>& more) { lights.insert(lights.end(), more.begin(), more.end()); };
    if (!scene.rig.empty()) {
        append(rigFromArgument(scene.rig).lights);
    }
    if (environment != nullptr) {
        append(lightsFromEnvironment(*environment, scene.environmentLights.value_or(kEnvironmentLights),
                                     glm::radians(scene.environmentTurn)));
    }
    return lights;
}

Scene loadScene(const SceneDescription& description, const SceneInputs& inputs, const Context& context, bool quiet)
{
    Scene scene;
    scene.view = viewDirectionOf(description);
    Surface measured = loadMeasured(description, inputs);
    const bool hasResidual = !measured.residual.empty();
    LoadedSurface loaded = drawnSurfaceOf(description, inputs, std::move(measured), context, false);
    drawMeshOnce(description, context, loaded);
    scene.surface = std::move(loaded.surface);
    requireResidual(scene.surface, scene.view, description.residual);
    SceneDescription lit = description;
    resolveCaptured(lit, scene.surface.lights);
    std::optional<Environment> environment;
    if (!lit.environment.empty()) {
        environment = loadEnvironment(lit.environment);
        if (!quiet && !environment->clamped.empty()) {
            fmt::print(stderr, "nacre: note: {}: {}\n", lit.environment.string(), environment->clamped);
        }
    }
    scene.lights = lightsOfScene(lit, environment ? &*environment : nullptr, scene.surface.lights);
    if (!quiet && description.residual != ResidualUse::off) {
        noteResidual(scene, hasResidual);
    }
    return scene;
}

void noteUncertain(const Scene& scene)
{
    const std::string share = describeUncertainShare(uncertainShare(scene));
    if (!share.empty()) {
        fmt::print(stderr, "nacre: note: {}, judged by the BRDF alone; --show coverage marks it\n", share);
    }
}

} // namespace nacre
