#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "engine/lights/environment.h"
#include "engine/scene/ball_size.h"
#include "engine/surface/surface.h"
#include "engine/viewer/choices.h"
#include "engine/viewer/photographs.h"

namespace nacre {

// How what a state names is read; by the background as well. All throw Error.
struct SceneSource {
    // What a scene file's surface, material, onto, normalY and size draw.
    std::function<Surface(const SceneFile&)> surface;
    std::function<Material(const std::string& specification)> material;
    std::function<glm::vec3(const SceneFile&)> view;              // unit, towards the viewer
    std::function<Choices(const std::filesystem::path&)> choices; // of a surface
    std::optional<Photographs> photographs;
};

// A surface to draw, and how finely its materials' balls are sampled.
struct DrawnSurface {
    Surface surface;
    std::vector<BallSize> ballSizes;
};

// What a state's pictures are drawn from. The wipe's other side and the environment are null where there is none.
struct LoadedScene {
    std::shared_ptr<const DrawnSurface> main;
    std::shared_ptr<const DrawnSurface> other;
    std::shared_ptr<const Environment> environment;
};

// Throws Error (usage) where the state shows verdicts, its captured lights resolved, and no photograph is at hand.
void requireShown(const ViewState& state, const SceneSource& source);

// The part of a state that loading depends on: states that share it share what is loaded.
SceneFile loadedPart(const ViewState& state);

// The scene that draws the wipe's other side.
SceneFile otherPart(const ViewState& state, const Choices& choices);

// `before` is taken from where it was loaded for the same. Throws Error.
LoadedScene loadScene(const SceneSource& source, const ViewState& state, const Choices& choices,
                      const ViewState& stateBefore, const LoadedScene& before);

} // namespace nacre
