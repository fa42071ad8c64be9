#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <imgui.h>

#include "engine/files/error.h"
#include "engine/viewer/screenshot.h"
#include "engine/viewer/viewer_window.h"

namespace nacre {

namespace {

constexpr float kWipeReach = 6; // units of layout around the line
constexpr int kFramesToSettle = 3;

} // namespace

void ViewerWindow::takeEvents(const WindowEvents& events)
{
    if (!events.any) {
        framesLeft_ = std::max(framesLeft_, sceneLoader_.isBusy() || photographLoader_.isBusy() ? 1 : 0);
        return;
    }
    framesLeft_ = kFramesToSettle;
    if (events.resized) {
        swapchain_.rebuild();
    }
    if (swapchain_.isEmpty()) {
        return;
    }
    takeMouse(events);
    if (!ImGui::GetIO().WantTextInput) {
        for (const KeyPress& press : events.keys) {
            session_.message.clear();
            act(session_, choices_, press);
        }
    }
    for (const std::filesystem::path& file : events.dropped) {
        drop(file);
    }
}

void ViewerWindow::takeMouse(const WindowEvents& events)
{
    const glm::vec2 cursor = window_.cursor(), moved = cursor - cursor_;
    cursor_ = cursor;
    const Area area = pictureArea();
    const bool isOver = area.holds(cursor) && !session_.help;
    if (drag_ != Drag::none) {
        drag(moved);
        if (!window_.isHeld(drag_ == Drag::light ? 1 : 0)) {
            drag_ = Drag::none;
        }
    } else if (isOver && events.pressed[1]) {
        drag_ = Drag::light;
        session_.playing = false;
    } else if (isOver && events.pressed[0]) {
        const float line = screenFromPicture({pictures_.wipeColumn(), 0}, framing(), area).x;
        const bool isAtLine = pictures_.other() != nullptr && std::abs(cursor.x - line) < kWipeReach * ui_.scale();
        drag_ = isAtLine ? Drag::wipe : Drag::pan;
    }
    if (isOver && events.wheel != 0) {
        session_.state.framing = zoomed(session_.state.framing, events.wheel, cursor, pictures_.size(), area);
    }
    if (isOver && events.doubleClicked) {
        act(session_, choices_, Action::fit);
    }
    if (isOver && drag_ == Drag::none) {
        inspect(cursor);
    }
}

void ViewerWindow::drag(const glm::vec2& moved)
{
    if (moved == glm::vec2(0)) {
        return;
    }
    const Area area = pictureArea();
    if (drag_ == Drag::pan) {
        session_.state.framing = panned(session_.state.framing, moved, pictures_.size(), area);
    } else if (drag_ == Drag::light) {
        dragLight(session_, moved, static_cast<float>(swapchain_.extent().height));
    } else {
        const float column = pictureFromScreen(cursor_, framing(), area).x;
        session_.state.wipe.at = glm::clamp(column / static_cast<float>(pictures_.size().x), 0.0f, 1.0f);
    }
}

void ViewerWindow::inspect(const glm::vec2& cursor)
{
    const glm::vec2 at = glm::floor(pictureFromScreen(cursor, framing(), pictureArea()));
    const glm::ivec2 pixel(at), size = pictures_.size();
    if (pixel.x >= 0 && pixel.y >= 0 && pixel.x < size.x && pixel.y < size.y) {
        pixel_ = pixel;
    }
}

void ViewerWindow::drop(const std::filesystem::path& file)
{
    session_.message.clear();
    const Dropped kind = kindOf(file);
    if (kind == Dropped::surface) {
        openSurface(file);
    } else if (kind == Dropped::unknown || kind == Dropped::state) {
        session_.message = fmt::format("{}: is no surface, material, picture of normals or environment", file.string());
    } else {
        Drop undo{choices_, session_.state, {}};
        choose(kind, file);
        undo.after = session_.state;
        drop_ = std::move(undo);
    }
}

// What was dropped joins its list, and is chosen.
void ViewerWindow::choose(Dropped kind, const std::filesystem::path& file)
{
    const std::string name = file.stem().string();
    if (kind == Dropped::target) {
        choices_.targets.push_back({name, file});
        session_.state.targets.push_back(file);
        chooseTarget(session_, choices_, choices_.targets.size() - 1);
    } else if (kind == Dropped::material) {
        choices_.materials.push_back({name, file.string()});
        session_.state.materials.push_back(file.string());
        chooseMaterial(session_, choices_, choices_.materials.size() - 1);
    } else {
        choices_.environments.push_back(file);
        session_.state.environments.push_back(file);
        chooseEnvironment(session_, choices_, choices_.environments.size() - 1);
    }
}

// Of what the state shows, in its own size; once it is loaded.
void ViewerWindow::takeScreenshot()
{
    const bool waitsForVerdicts = session_.state.show == Show::verdicts && photographLoader_.isBusy();
    if (sceneLoader_.isBusy() || waitsForVerdicts) {
        return;
    }
    session_.wantsScreenshot = false;
    try {
        applyState();
        const std::filesystem::path file = nextScreenshot(options_.screenshots);
        saveScreenshot(file, pictures_.picture(), session_.state);
        session_.message = fmt::format("wrote {} and its state", file.string());
    } catch (const Error& e) {
        session_.message = e.what();
    }
    framesLeft_ = kFramesToSettle;
}

} // namespace nacre
