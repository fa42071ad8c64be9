#pragma once
#include <memory>
#include <optional>

#include "engine/gpu/context.h"
#include "engine/lights/environment.h"
#include "engine/loading/scene_loading.h"
#include "engine/scene/ball_size.h"
#include "engine/surface/surface.h"
#include "engine/target/mesh_raster.h"
#include "engine/view_state/choices.h"
#include "engine/viewer/photographs.h"

namespace nacre {

// From what a state is read beside the files that it names; by the background as well.
struct SceneSource {
    const Context& context;
    SceneInputs inputs;
    std::vector<std::filesystem::path> shapes; // generated ones, that are offered beside the surface's own
    std::shared_ptr<Photographs> photographs;  // null: none, so no verdicts
};

// A surface to draw, and how finely its materials' balls are sampled.
struct DrawnSurface {
    Surface surface;
    std::vector<BallSize> ballSizes;
    std::shared_ptr<const Mesh> mesh{};   // on which the surface lies, its pixels as they were drawn last; null: none
    std::unique_ptr<MeshRaster> raster{}; // of the mesh, once it has been drawn
};

// What a state's pictures are drawn from. The wipe's other side and the environment are null where there is none.
struct LoadedScene {
    std::shared_ptr<DrawnSurface> main;
    std::shared_ptr<DrawnSurface> other;
    std::shared_ptr<const Environment> environment;
};

// Throws Error (usage) where the state, its captured lights resolved, shows verdicts that are not one photograph's.
void requireShown(const ViewState& state);

// The part of a state that loading surfaces depends on: states that share it share what is loaded.
ViewState loadedPart(const ViewState& state);

// `before` is taken from where it was loaded for the same. Throws Error.
LoadedScene loadScene(const SceneSource& source, const ViewState& state, const Choices& choices,
                      const ViewState& stateBefore, const LoadedScene& before);

} // namespace nacre
