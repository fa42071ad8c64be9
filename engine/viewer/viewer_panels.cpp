#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "engine/viewer/viewer_window.h"

namespace nacre {

namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBackground |
                                    ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus;

} // namespace

PanelInputs ViewerWindow::panelInputs()
{
    const DrawnSurface* drawn = pictures_.scene().main.get();
    const bool hasBall = !drawn->surface.materials.empty();
    return {.choices = choices_,
            .thumbnails = thumbnails_,
            .ball = hasBall ? &ball_.drawnPicture() : nullptr,
            .drawn = drawn,
            .photographs = photographsAreRead_ && session_.state.onto.empty() ? &*photographs_ : nullptr,
            .verdicts = pictures_.verdicts(),
            .pixel = pixel_,
            .comparisonFigures = comparisonFigures_,
            .scale = ui_.scale()};
}

void ViewerWindow::placePicture()
{
    const Framing framing = this->framing();
    const Area area = pictureArea();
    const int width = pictures_.size().x, column = pictures_.wipeColumn();
    if (comparison_) {
        placed_.push_back({&*comparison_, 0, width, framing, area});
        return;
    }
    placed_.push_back({&pictures_.main(), 0, column, framing, area});
    if (pictures_.other() != nullptr) {
        placed_.push_back({pictures_.other(), column, width, framing, area});
    }
}

void ViewerWindow::showPanels()
{
    const glm::vec2 size(swapchain_.extent().width, swapchain_.extent().height);
    const PanelInputs inputs = panelInputs();
    ImGui::SetNextWindowPos({size.x - panelWidth(), 0});
    ImGui::SetNextWindowSize({panelWidth(), size.y});
    ImGui::Begin("panel", nullptr, kFixed);
    showLightPanel(session_, inputs, placed_);
    showMaterialPanel(session_, inputs, placed_);
    showDisplayPanel(session_, inputs);
    ImGui::End();
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({inspectorWidth(), pictureArea().size.y});
    ImGui::Begin("inspector", nullptr, kFixed);
    showPhotographPanel(session_, inputs);
    showInspectorPanel(session_, inputs);
    ImGui::End();
    showWipeLine();
    showStatus();
    if (session_.help) {
        showHelp(size, ui_.scale());
    }
}

void ViewerWindow::showWipeLine()
{
    if (pictures_.other() == nullptr || comparison_) {
        return;
    }
    const Area area = pictureArea();
    const float x = screenFromPicture({pictures_.wipeColumn(), 0}, framing(), area).x;
    if (x >= area.origin.x && x < area.origin.x + area.size.x) {
        ImGui::GetBackgroundDrawList()->AddLine({x, area.origin.y}, {x, area.origin.y + area.size.y},
                                                IM_COL32(255, 255, 255, 160), ui_.scale());
    }
}

void ViewerWindow::showStatus()
{
    const Area area = pictureArea();
    ImGui::SetNextWindowPos({0, area.size.y});
    ImGui::SetNextWindowSize(
        {area.origin.x + area.size.x, static_cast<float>(swapchain_.extent().height) - area.size.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8 * ui_.scale(), 2 * ui_.scale()});
    ImGui::Begin("status", nullptr, kFixed | ImGuiWindowFlags_NoScrollbar);
    Loader* busy = sceneLoader_.isBusy() ? &sceneLoader_ : photographLoader_.isBusy() ? &photographLoader_ : nullptr;
    if (busy != nullptr) {
        if (ImGui::SmallButton("Cancel")) { // leftmost, where it stays whatever the name's length
            cancelLoading();
        }
        ImGui::SameLine();
        const float share = busy->share();
        const float waiting = static_cast<float>(std::fmod(ImGui::GetTime(), 1.0)); // goes round where it is not known
        ImGui::ProgressBar(share > 0 ? share : waiting, {160 * ui_.scale(), 0}, share > 0 ? nullptr : "");
        ImGui::SameLine();
        ImGui::TextUnformatted(busy->name().c_str());
    } else if (!session_.message.empty()) {
        ImGui::TextUnformatted(session_.message.c_str());
    } else {
        const glm::ivec2 size = pictures_.size();
        ImGui::TextDisabled("%d x %d   zoom %.0f %%   H: help", size.x, size.y,
                            static_cast<double>(100 * framing().zoom));
    }
    ImGui::End();
    ImGui::PopStyleVar();
}

} // namespace nacre
