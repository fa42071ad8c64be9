#include "engine/view_state/controls.h"

#include <algorithm>
#include <cmath>

#include "engine/view_state/light_ball.h"

namespace nacre {

namespace {

// The captured light that a photograph shows no longer stands alone.
void leavePhotograph(Session& session)
{
    session.photograph.reset();
    session.comparison = Comparison::none;
}

void moveLight(Session& session, const glm::vec3& direction)
{
    if (session.light >= session.state.lights.size()) {
        return;
    }
    leavePhotograph(session);
    LightSource& light = session.state.lights[session.light];
    light.captured = 0;
    light.direction = direction;
}

void toggleShow(Session& session, Show show)
{
    session.state.show = session.state.show == show ? Show::picture : show;
    session.comparison = Comparison::none;
}

void stepPhotograph(Session& session, const Choices& choices, bool forward)
{
    const size_t count = choices.captured.size();
    if (count > 0) {
        const auto shown = session.photograph ? session.photograph : shownPhotograph(session.state);
        const size_t current = shown.value_or(forward ? count - 1 : 0);
        showCapturedLight(session, choices, (current + (forward ? 1 : count - 1)) % count);
    } else {
        session.message = "this surface has no captured lights";
    }
}

// Whether a photograph is at hand for what the state shows; then its light is the one that shines.
bool standAtPhotograph(Session& session, const Choices& choices)
{
    if (!session.hasPhotographs || choices.captured.empty()) {
        session.message = "needs the photographs of the surface on its own shape: open its capture with it";
        return false;
    }
    const auto shown = session.photograph ? session.photograph : shownPhotograph(session.state);
    showCapturedLight(session, choices, shown.value_or(0));
    return true;
}

void toggleVerdicts(Session& session, const Choices& choices)
{
    if (session.state.show == Show::verdicts || standAtPhotograph(session, choices)) {
        toggleShow(session, Show::verdicts);
    }
}

void toggleComparison(Session& session, const Choices& choices, Comparison comparison)
{
    if (!standAtPhotograph(session, choices)) {
        return;
    }
    session.comparison = session.comparison == comparison ? Comparison::none : comparison;
    session.state.show = Show::picture;
    if (session.state.residual == ResidualUse::alone) {
        session.state.residual = ResidualUse::on;
    }
}

void stepResidual(Session& session)
{
    if (!session.hasResidual) {
        session.message = "what is drawn has no residual layer: one is measured where the surface is acquired";
        return;
    }
    switch (session.state.residual) {
    case ResidualUse::on:
        return chooseResidual(session, ResidualUse::off);
    case ResidualUse::off:
        return chooseResidual(session, ResidualUse::alone);
    case ResidualUse::alone:
        return chooseResidual(session, ResidualUse::on);
    }
}

void toggleWipe(Session& session, const Choices& choices)
{
    const auto chosen = chosenMaterial(session.state, choices);
    if (!session.state.wipe.material.empty()) {
        session.state.wipe = {};
    } else if (choices.materials.size() > 1) {
        chooseWipe(session, choices, (chosen.value_or(0) + 1) % choices.materials.size());
    } else {
        session.message = "there is one material: drop another one to wipe to";
    }
}

void stepTarget(Session& session, const Choices& choices)
{
    const size_t count = choices.targets.size();
    if (count < 2) {
        session.message = "there is one shape: drop another one";
    } else {
        chooseTarget(session, choices, (chosenTarget(session.state, choices).value_or(count - 1) + 1) % count);
    }
}

// Actions that a key which is held goes on with; the others would flicker.
bool steps(Action action)
{
    return action == Action::brighter || action == Action::darker || action == Action::previousPhotograph ||
           action == Action::nextPhotograph;
}

void stepHistory(Session& session, bool forward)
{
    if (!(forward ? session.history.redo(session.state) : session.history.undo(session.state))) {
        session.message = forward ? "nothing of the lights was undone" : "the lights were not changed";
        return;
    }
    session.playing = false;
    session.light = session.light < session.state.lights.size() ? session.light : 0;
    leavePhotograph(session);
}

void scaleText(Session& session, float factor)
{
    session.textScale = std::clamp(factor * session.textScale, kLeastTextScale, kMostTextScale);
}

void changeExposure(Session& session, float stops)
{
    session.state.exposure = session.state.exposure.value_or(0.0f) + stops;
}

// As they stand before the object.
void turnLights(ViewState& state, const Turn& before)
{
    const glm::dmat3 turned = matrixOf(state.turn) * glm::transpose(matrixOf(before));
    for (LightSource& light : state.lights) {
        light.direction = glm::vec3(turned * glm::dvec3(light.direction));
        light.captured = 0;
    }
}

} // namespace

void act(Session& session, const Choices& choices, const KeyPress& press)
{
    const KeyBinding* binding = bindingOf(press);
    if (binding != nullptr && (!press.isRepeat || steps(binding->action))) {
        act(session, choices, binding->action, static_cast<size_t>(press.key - binding->key));
    }
}

void act(Session& session, const Choices& choices, Action action, size_t number)
{
    switch (action) {
    case Action::help:
        session.help = !session.help;
        return;
    case Action::material:
        chooseMaterial(session, choices, number);
        return;
    case Action::target:
        return stepTarget(session, choices);
    case Action::brighter:
        return changeExposure(session, kExposureStep);
    case Action::darker:
        return changeExposure(session, -kExposureStep);
    case Action::normals:
        return toggleShow(session, Show::normals);
    case Action::coverage:
        return toggleShow(session, Show::coverage);
    case Action::labels:
        return toggleShow(session, Show::labels);
    case Action::verdicts:
        return toggleVerdicts(session, choices);
    case Action::residual:
        return stepResidual(session);
    case Action::wipe:
        return toggleWipe(session, choices);
    case Action::play:
        session.playing = !session.playing;
        return;
    case Action::follow:
        session.lightsFollow = !session.lightsFollow;
        session.message = session.lightsFollow ? "lights turn with the object" : "lights stay with the camera";
        return;
    case Action::reset:
        session.state = session.opened;
        session.playing = false;
        session.light = 0;
        return leavePhotograph(session);
    case Action::fit:
        session.state.framing = {};
        return;
    case Action::previousPhotograph:
        return stepPhotograph(session, choices, false);
    case Action::nextPhotograph:
        return stepPhotograph(session, choices, true);
    case Action::photograph:
        return toggleComparison(session, choices, Comparison::photograph);
    case Action::difference:
        return toggleComparison(session, choices, Comparison::difference);
    case Action::screenshot:
        session.wantsScreenshot = true;
        return;
    case Action::undo:
        return stepHistory(session, false);
    case Action::redo:
        return stepHistory(session, true);
    case Action::larger:
        return scaleText(session, kTextStep);
    case Action::smaller:
        return scaleText(session, 1 / kTextStep);
    case Action::quit:
        session.wantsToQuit = !session.help;
        session.help = false;
        return;
    }
}

void chooseMaterial(Session& session, const Choices& choices, size_t material)
{
    if (material < choices.materials.size()) {
        const size_t target = chosenTarget(session.state, choices).value_or(0);
        session.state = withChoice(session.state, choices, material, target);
    } else {
        session.message = "there is no material of this number";
    }
}

void chooseTarget(Session& session, const Choices& choices, size_t target)
{
    if (target < choices.targets.size()) {
        const size_t material = chosenMaterial(session.state, choices).value_or(0);
        session.state = withChoice(session.state, choices, material, target);
        session.state.turn = {};
        leavePhotograph(session);
    }
}

void chooseWipe(Session& session, const Choices& choices, size_t material)
{
    if (material < choices.materials.size()) {
        session.state.wipe.material = specificationOf(choices, material);
    }
}

void chooseEnvironment(Session& session, const Choices& choices, std::optional<size_t> environment)
{
    ViewState& state = session.state;
    leavePhotograph(session);
    session.light = 0;
    if (environment && *environment < choices.environments.size()) {
        state.environment = choices.environments[*environment];
        state.lights.clear();
    } else if (!environment && !state.environment.empty()) {
        state.environment.clear();
        if (state.lights.empty()) { // something has to light the scene
            addLight(session);
        }
    }
}

void showCapturedLight(Session& session, const Choices& choices, size_t index)
{
    if (index >= choices.captured.size()) {
        return;
    }
    const Light& light = choices.captured[index].light;
    const int number = session.state.surface.empty() ? 0 : static_cast<int>(index) + 1;
    session.state.lights = {
        {.captured = number, .direction = light.direction, .irradiance = light.irradiance, .distance = light.distance}};
    session.state.environment.clear();
    session.light = 0;
    session.playing = false;
    session.photograph = index;
}

void pointLight(Session& session, const glm::vec2& disc)
{
    moveLight(session, lightFromBallDisc(disc));
}

void dragLight(Session& session, const glm::vec2& moved, float windowHeight)
{
    if (session.light < session.state.lights.size()) {
        const glm::vec2 radii = glm::vec2(moved.x, -moved.y) / (kBallRadiusOfDrag * windowHeight);
        moveLight(session, draggedLight(session.state.lights[session.light].direction, radii));
    }
}

void pushLight(Session& session, float steps)
{
    if (session.light >= session.state.lights.size() || steps == 0) {
        return;
    }
    leavePhotograph(session);
    LightSource& light = session.state.lights[session.light];
    const float nearest = static_cast<float>(kNearestLight);
    const float distance = std::min(light.distance, kFarthestChosen * kDistanceStep) * std::pow(kDistanceStep, steps);
    light.captured = 0;
    light.distance = distance > kFarthestChosen * 1.001f ? LightSource().distance : std::max(distance, nearest);
}

void turnObject(Session& session, const glm::vec2& moved)
{
    if (!session.canTurn) {
        session.message = "this shape has no height: only meshes, and surfaces with a height, can be turned";
        return;
    }
    Turn& turn = session.state.turn;
    const Turn before = turn;
    turn.yaw = std::remainder(turn.yaw + kTurnOfDrag * moved.x, 360.0f);
    turn.pitch = std::clamp(turn.pitch + kTurnOfDrag * moved.y, -90.0f, 90.0f);
    if (session.lightsFollow) {
        turnLights(session.state, before);
    }
}

void addLight(Session& session)
{
    // Each next one a third of a turn further, so that they do not hide behind each other.
    const float azimuth = 2.0944f * static_cast<float>(session.state.lights.size()) + 0.9f;
    leavePhotograph(session);
    session.state.lights.push_back(
        {.direction = lightFromBallDisc(0.6f * glm::vec2(std::cos(azimuth), std::sin(azimuth)))});
    session.light = session.state.lights.size() - 1;
}

void removeLight(Session& session)
{
    std::vector<LightSource>& lights = session.state.lights;
    const bool isLast = lights.size() == 1 && session.state.environment.empty(); // something has to light the scene
    if (session.light < lights.size() && !isLast) {
        leavePhotograph(session);
        lights.erase(lights.begin() + static_cast<std::ptrdiff_t>(session.light));
        session.light = std::min(session.light, lights.empty() ? 0 : lights.size() - 1);
    }
}

// A photograph is compared with the picture, which a layer by itself is not.
void chooseResidual(Session& session, ResidualUse use)
{
    session.state.residual = use;
    if (session.state.show != Show::coverage) {
        session.state.show = Show::picture;
    }
    if (use == ResidualUse::alone) {
        session.comparison = Comparison::none;
    }
}

void settleShow(Session& session)
{
    if (session.state.show == Show::verdicts && !shownPhotograph(session.state)) {
        session.state.show = Show::picture;
    }
    if (session.state.residual == ResidualUse::alone && !session.hasResidual) {
        session.state.residual = ResidualUse::on;
    }
}

void play(Session& session, float seconds)
{
    const float turn = 2 * kPi * seconds / kSecondsAround;
    const float c = std::cos(turn), s = std::sin(turn);
    leavePhotograph(session);
    for (LightSource& light : session.state.lights) {
        const glm::vec3 d = light.direction;
        light.captured = 0;
        light.direction = {c * d.x - s * d.y, s * d.x + c * d.y, d.z};
    }
}

} // namespace nacre
