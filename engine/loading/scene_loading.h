#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/gpu/context.h"
#include "engine/lights/environment.h"
#include "engine/lights/light.h"
#include "engine/scene/scene.h"
#include "engine/scene/scene_description.h"
#include "engine/target/mesh_raster.h"

namespace nacre {

// Lights that are on together.
struct LightRig {
    std::string name; // for captions and file names
    std::vector<Light> lights;
};

// One value of --rig: a preset (lightsOfRig); a file of lights as nacre calibrate writes it (.json, .lp), all of them
// or FILE#N the one of photograph N from 1; an environment (.exr, .hdr). Throws Error: usage that lists the presets
// where it is none of these, data where the file cannot be used.
LightRig rigFromArgument(const std::string& text);

// Throws Error (usage) where parts of the description contradict each other; before anything is read.
void requireConsistent(const SceneDescription& scene);

// Bakes the horizon of the height of a surface that was read from `source`. A captured surface has none: its normals
// are integrated, and stderr says so. Throws Error (usage) for a bare normal map.
void castShadows(Surface& surface, const std::filesystem::path& source);

// What scenes are loaded from beside the files that they name.
struct SceneInputs {
    std::filesystem::path fits{}; // folder of fitted models; empty: fitsFolderFrom
    // The shape of make:SPECIFICATION. Empty: no such shapes.
    std::function<Surface(const std::string& specification, const PictureSize& size)> makeShape{};
};

// A surface to draw. Of one on a mesh the pixels are to be drawn by drawMesh, at any turn; of a relief only a turned
// one's.
struct LoadedSurface {
    Surface surface;
    std::shared_ptr<const Mesh> mesh; // null: the surface has its pixels
};

// As loadDrawnSurface, without drawing a mesh; with `canTurn` of a surface that has a height its relief as well.
LoadedSurface loadSurfaceOrMesh(const SceneDescription& scene, const SceneInputs& inputs, const Context& context,
                                bool canTurn);

// The surface's pixels: normals, heights and, of its first material, labels of the mesh at the scene's turn and size;
// with horizons where it is to cast shadows, unless it is coarse. Of a relief, all that its picture has; turned,
// without a residual layer. Throws Error.
void drawMesh(MeshRaster& raster, const SceneDescription& scene, Surface& surface, bool isCoarse = false);

// MeshRaster::drawPixels of the same mesh at the same turn: all of the picture, or the zoom's part of it.
std::shared_ptr<const PixelTextures> drawMeshPixels(MeshRaster& raster, const SceneDescription& scene,
                                                    const std::optional<Zoom>& zoom);

// For drawMesh: in the scene's size.
std::unique_ptr<MeshRaster> meshRasterFor(const Context& context, std::shared_ptr<const Mesh> mesh,
                                          const SceneDescription& scene);

// The surface, or its material or the named one on other normals, fitted into the size; with the captured lights of the
// measured one.
Surface loadDrawnSurface(const SceneDescription& scene, const SceneInputs& inputs, const Context& context);

// All directional lights: those named, the rig's, the environment's (null: there is none, or it is not read yet).
std::vector<Light> lightsOfScene(const SceneDescription& scene, const Environment* environment,
                                 std::span<const CapturedLight> captured);

// The surface with the lights, the default one where there is none, and the view. Throws Error (usage) where the
// residual layer by itself is asked for and there is none; says on stderr, unless quiet, where it is left out or fades
// out.
Scene loadScene(const SceneDescription& scene, const SceneInputs& inputs, const Context& context, bool quiet);

// Says on stderr how much of the picture is uncertain, if any is.
void noteUncertain(const Scene& scene);

} // namespace nacre
