#include "engine/viewer/view_state.h"

#include "engine/scene/scene_names.h"

namespace nacre {

namespace {

Framing framingOf(const WindowFile& window)
{
    if (!window.zoom || window.centre.size() != 2) {
        return {};
    }
    return {.zoom = *window.zoom, .centre = {window.centre[0], window.centre[1]}};
}

} // namespace

ViewState viewStateOf(const SceneFile& scene)
{
    ViewState state{.surface = scene.surface,
                    .material = scene.material,
                    .onto = scene.onto,
                    .normalY = scene.normalY,
                    .size = scene.size,
                    .lights = {},
                    .environment = scene.environment,
                    .environmentLights = scene.environmentLights,
                    .environmentTurn = scene.environmentTurn.value_or(0),
                    .exposure = scene.exposure,
                    .toneCurve = toneCurveFromName(scene.tone),
                    .view = scene.view,
                    .path = scene.path,
                    .show = showFromName(scene.show),
                    .framing = framingOf(scene.window),
                    .shadows = scene.shadows,
                    .residual = residualUseFromName(scene.residual),
                    .materials = scene.window.materials,
                    .targets = scene.window.targets,
                    .environments = scene.window.environments,
                    .wipe = {scene.window.wipeMaterial, scene.window.wipeAt.value_or(0.5f)}};
    for (const std::string& text : scene.lights) {
        state.lights.push_back(lightSourceFromText(text));
    }
    return state;
}

SceneFile sceneFileOf(const ViewState& state)
{
    SceneFile scene{.surface = state.surface,
                    .material = state.material,
                    .onto = state.onto,
                    .normalY = state.normalY,
                    .size = state.size,
                    .lights = {},
                    .environment = state.environment,
                    .environmentLights = state.environmentLights,
                    .environmentTurn = {},
                    .view = state.view,
                    .path = state.path,
                    .exposure = state.exposure,
                    .tone = state.toneCurve == kToneSrgb ? "" : nameOfToneCurve(state.toneCurve),
                    .show = state.show == Show::picture ? "" : nameOf(state.show),
                    .frames = {},
                    .motion = {},
                    .shadows = state.shadows,
                    .residual = state.residual == ResidualUse::on ? "" : nameOf(state.residual),
                    .window = {.zoom = {},
                               .centre = {},
                               .materials = state.materials,
                               .targets = state.targets,
                               .environments = state.environments,
                               .wipeMaterial = state.wipe.material,
                               .wipeAt = {}}};
    for (const LightSource& light : state.lights) {
        scene.lights.push_back(textOf(light));
    }
    if (!state.environment.empty()) {
        scene.environmentTurn = state.environmentTurn;
    }
    if (state.framing.zoom > 0) {
        scene.window.zoom = state.framing.zoom;
        scene.window.centre = {state.framing.centre.x, state.framing.centre.y};
    }
    if (!state.wipe.material.empty()) {
        scene.window.wipeAt = state.wipe.at;
    }
    return scene;
}

std::optional<size_t> shownPhotograph(const ViewState& state)
{
    const bool isAlone = state.lights.size() == 1 && state.environment.empty();
    const bool isOwn = !state.surface.empty() && state.material.empty() && state.onto.empty();
    if (!isAlone || !isOwn || state.lights[0].captured < 1) {
        return {};
    }
    return static_cast<size_t>(state.lights[0].captured - 1);
}

void resolveCaptured(ViewState& state, std::span<const CapturedLight> captured)
{
    if (state.lights.empty() && state.environment.empty()) {
        state.lights = {defaultLightSource(captured)};
    }
    for (LightSource& source : state.lights) {
        if (source.captured > 0) {
            const Light light = lightOf(source, captured);
            source.direction = light.direction;
            source.irradiance = light.irradiance;
        }
    }
}

} // namespace nacre
