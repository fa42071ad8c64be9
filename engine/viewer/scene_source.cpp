#include "engine/viewer/scene_source.h"

#include "engine/files/error.h"

namespace nacre {

namespace {

std::shared_ptr<const DrawnSurface> drawnSurface(const SceneSource& source, const SceneFile& scene)
{
    auto drawn = std::make_shared<DrawnSurface>();
    drawn->surface = source.surface(scene);
    for (const Material& material : drawn->surface.materials) {
        drawn->ballSizes.push_back(measuredBallSize(material.table));
    }
    return drawn;
}

} // namespace

void requireShown(const ViewState& state, const SceneSource& source)
{
    if (state.show != Show::verdicts) {
        return;
    }
    if (!source.photographs) {
        throw Error("", "--show verdicts needs the photographs", "--capture FOLDER with it", Error::kUsage);
    }
    if (!shownPhotograph(state)) {
        throw Error("", "--show verdicts is of one photograph",
                    "--light captured:N alone, and the surface on its own shape", Error::kUsage);
    }
}

SceneFile loadedPart(const ViewState& state)
{
    SceneFile scene;
    scene.surface = state.surface;
    scene.material = state.material;
    scene.onto = state.onto;
    scene.normalY = state.normalY;
    scene.size = state.size;
    scene.shadows = state.shadows;
    return scene;
}

SceneFile otherPart(const ViewState& state, const Choices& choices)
{
    SceneFile scene = loadedPart(state);
    scene.surface.clear();
    scene.material = state.wipe.material;
    scene.onto = state.onto.empty() ? choices.surface : state.onto;
    return scene;
}

LoadedScene loadScene(const SceneSource& source, const ViewState& state, const Choices& choices,
                      const ViewState& stateBefore, const LoadedScene& before)
{
    LoadedScene loaded;
    const SceneFile scene = loadedPart(state);
    loaded.main = before.main && scene == loadedPart(stateBefore) ? before.main : drawnSurface(source, scene);
    if (!state.wipe.material.empty()) {
        const SceneFile other = otherPart(state, choices);
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
