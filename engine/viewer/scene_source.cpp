#include "engine/viewer/scene_source.h"

#include "engine/files/error.h"
#include "engine/loading/scene_loading.h"

namespace nacre {

namespace {

std::shared_ptr<DrawnSurface> drawnSurface(const SceneSource& source, const ViewState& scene)
{
    auto drawn = std::make_shared<DrawnSurface>();
    LoadedSurface loaded = loadSurfaceOrMesh(scene, source.inputs, source.context, true);
    drawn->surface = std::move(loaded.surface);
    drawn->mesh = std::move(loaded.mesh);
    for (const Material& material : drawn->surface.materials) {
        drawn->ballSizes.push_back(measuredBallSize(material.table));
    }
    return drawn;
}

// The scene that draws the wipe's other side.
ViewState otherPart(const ViewState& state, const Choices& choices)
{
    ViewState scene = loadedPart(state);
    scene.surface.clear();
    scene.material = state.wipe.material;
    scene.onto = state.onto.empty() ? choices.surface : state.onto;
    return scene;
}

} // namespace

void requireShown(const ViewState& state)
{
    if (state.show == Show::verdicts && !shownPhotograph(state)) {
        throw Error("", "verdicts are of one photograph",
                    "the light captured:N alone, and the surface on its own shape", Error::kUsage);
    }
}

ViewState loadedPart(const ViewState& state)
{
    ViewState scene;
    scene.surface = state.surface;
    scene.material = state.material;
    scene.onto = state.onto;
    scene.normalY = state.normalY;
    scene.size = state.size;
    scene.shadows = state.shadows;
    return scene;
}

LoadedScene loadScene(const SceneSource& source, const ViewState& state, const Choices& choices,
                      const ViewState& stateBefore, const LoadedScene& before)
{
    LoadedScene loaded;
    const ViewState scene = loadedPart(state);
    loaded.main = before.main && scene == loadedPart(stateBefore) ? before.main : drawnSurface(source, scene);
    if (!state.wipe.material.empty()) {
        const ViewState other = otherPart(state, choices);
        loaded.other =
            before.other && other == otherPart(stateBefore, choices) ? before.other : drawnSurface(source, other);
    }
    if (!state.environment.empty()) {
        const bool isSame = before.environment && state.environment == stateBefore.environment;
        loaded.environment =
            isSame ? before.environment : std::make_shared<const Environment>(loadEnvironment(state.environment));
    }
    return loaded;
}

} // namespace nacre
