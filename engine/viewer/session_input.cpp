#include "engine/viewer/session_input.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <imgui.h>

namespace nacre {

namespace {

constexpr float kWipeReach = 6; // units of layout around the line

} // namespace

SessionInput::SessionInput(ViewState state, Choices listed) : choices(std::move(listed))
{
    session.state = std::move(state);
}

Framing SessionInput::framing(const Stage& stage) const
{
    return resolved(session.state.framing, stage.picture, stage.area);
}

std::optional<std::filesystem::path> SessionInput::take(const WindowEvents& events, const Window& window,
                                                        const Stage& stage)
{
    if (events.pressed[0] || events.pressed[1] || events.pressed[2]) {
        session.message.clear();
    }
    const bool isTyping = ImGui::GetIO().WantTextInput;
    session.history.follow(session.state, isHeld_ || isTyping || session.playing); // what panels have changed since
    takeMouse(events, window, stage);
    isHeld_ = window.isHeld(0) || window.isHeld(1) || window.isHeld(2);
    session.history.follow(session.state, isHeld_ || isTyping || session.playing);
    if (!isHeld_) {
        atRest_ = session.state.lights;
    }
    movesLights_ = session.playing || !(session.state.lights == atRest_);
    for (const KeyPress& press : events.keys) {
        if (isTyping && press.key == kKeyEnter) {
            ImGui::SetWindowFocus(nullptr); // ImGui does not see a key that is let go before the next frame
        } else if (!isTyping) {
            session.message.clear();
            act(session, choices, press);
        }
    }
    std::optional<std::filesystem::path> surface;
    for (const std::filesystem::path& file : events.dropped) {
        session.message.clear();
        const Dropped kind = kindOf(file);
        if (kind == Dropped::surface) {
            surface = file;
        } else if (kind == Dropped::unknown || kind == Dropped::state) {
            session.message = fmt::format("{}: is {}", file.string(), nameOf(kind));
        } else {
            Undo undo{choices, session.state, {}};
            choose(kind, file);
            session.message = fmt::format("{}: taken for {}", file.filename().string(), nameOf(kind));
            undo.after = session.state;
            undo_ = std::move(undo);
        }
    }
    return surface;
}

void SessionInput::takeMouse(const WindowEvents& events, const Window& window, const Stage& stage)
{
    const glm::vec2 cursor = window.cursor();
    const bool isOver = stage.area.holds(cursor) && !session.help;
    if (drag_ == Drag::none) {
        begin(events, window, stage);
    }
    if (drag_ != Drag::none) {
        const bool isHeld = window.isHeld(dragButton_);
        const glm::vec2 to = isHeld || !events.released[dragButton_] ? cursor : events.releasedAt;
        const glm::vec2 moved = to - std::exchange(cursor_, to);
        drag(moved, stage);
        drag_ = isHeld ? drag_ : Drag::none;
    }
    cursor_ = cursor;
    if (isOver && events.wheel != 0) {
        session.state.framing = zoomed(session.state.framing, events.wheel, cursor, stage.picture, stage.area);
    }
    if (isOver && events.doubleClicked) {
        act(session, choices, Action::fit);
    }
}

void SessionInput::begin(const WindowEvents& events, const Window& window, const Stage& stage)
{
    const bool isPressed = events.pressed[0] || events.pressed[1] || events.pressed[2];
    if (!isPressed || !stage.area.holds(events.pressedAt) || session.help) {
        return;
    }
    cursor_ = events.pressedAt;
    dragButton_ = events.pressed[1] ? 1 : events.pressed[2] ? 2 : 0;
    if (dragButton_ == 1) {
        drag_ = Drag::light;
        session.playing = false;
    } else if (dragButton_ == 2 || window.isShiftHeld()) {
        drag_ = Drag::turn;
    } else {
        const float line = screenFromPicture({stage.wipeColumn.value_or(0), 0}, framing(stage), stage.area).x;
        const bool isAtLine = stage.wipeColumn && std::abs(cursor_.x - line) < kWipeReach * stage.scale;
        drag_ = isAtLine ? Drag::wipe : Drag::pan;
    }
}

void SessionInput::drag(const glm::vec2& moved, const Stage& stage)
{
    if (moved == glm::vec2(0)) {
        return;
    }
    if (drag_ == Drag::pan) {
        session.state.framing = panned(session.state.framing, moved, stage.picture, stage.area);
    } else if (drag_ == Drag::turn) {
        turnObject(session, moved / stage.scale);
    } else if (drag_ == Drag::light) {
        dragLight(session, moved, stage.window.y);
    } else {
        const float column = pictureFromScreen(cursor_, framing(stage), stage.area).x;
        session.state.wipe.at = glm::clamp(column / static_cast<float>(stage.picture.x), 0.0f, 1.0f);
    }
}

void SessionInput::inspect(const Stage& stage)
{
    if (!stage.area.holds(cursor_) || session.help || drag_ != Drag::none) {
        return;
    }
    const glm::ivec2 at(glm::floor(pictureFromScreen(cursor_, framing(stage), stage.area)));
    if (at.x >= 0 && at.y >= 0 && at.x < stage.picture.x && at.y < stage.picture.y) {
        pixel = at;
    }
}

// What was dropped joins its list, and is chosen.
void SessionInput::choose(Dropped kind, const std::filesystem::path& file)
{
    const std::string name = file.stem().string();
    if (kind == Dropped::target) {
        choices.targets.push_back({name, file});
        session.state.targets.push_back(file);
        chooseTarget(session, choices, choices.targets.size() - 1);
    } else if (kind == Dropped::material) {
        choices.materials.push_back({name, file.string()});
        session.state.materials.push_back(file.string());
        chooseMaterial(session, choices, choices.materials.size() - 1);
    } else {
        choices.environments.push_back(file);
        session.state.environments.push_back(file);
        chooseEnvironment(session, choices, choices.environments.size() - 1);
    }
}

void SessionInput::goBackTo(const ViewState& shown)
{
    ViewState& state = session.state;
    if (undo_ && state == undo_->after) {
        state = undo_->before;
    } else if (undo_) { // what else was done meanwhile remains
        state.materials = undo_->before.materials;
        state.targets = undo_->before.targets;
        state.environments = undo_->before.environments;
    }
    if (undo_) {
        choices = undo_->choices;
        undo_.reset();
    }
    state.surface = shown.surface;
    state.material = shown.material;
    state.onto = shown.onto;
    state.normalY = shown.normalY;
    state.size = shown.size;
    state.shadows = shown.shadows;
    state.wipe = shown.wipe;
    state.environment = shown.environment;
    if (state.lights.empty() && state.environment.empty()) { // something has to light the scene
        addLight(session);
    }
}

} // namespace nacre
