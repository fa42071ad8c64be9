#include "engine/viewer/panels.h"

#include <cmath>

#include <imgui.h>

namespace nacre {

namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBackground |
                                    ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus;

Framing framingOf(const Session& session, const Stage& stage)
{
    return resolved(session.state.framing, stage.picture, stage.area);
}

} // namespace

void showPanels(Session& session, const PanelInputs& inputs, const Stage& stage, float width,
                std::vector<PlacedPicture>& placed)
{
    ImGui::SetNextWindowPos({stage.window.x - width, 0});
    ImGui::SetNextWindowSize({width, stage.window.y});
    ImGui::Begin("panel", nullptr, kFixed);
    showLightPanel(session, inputs, placed);
    showMaterialPanel(session, inputs, placed);
    showDisplayPanel(session);
    ImGui::End();
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({stage.area.origin.x, stage.area.size.y});
    ImGui::Begin("inspector", nullptr, kFixed);
    showPhotographPanel(session, inputs);
    showInspectorPanel(session, inputs);
    ImGui::End();
}

void showWipeLine(const Session& session, const Stage& stage)
{
    const Area& area = stage.area;
    const float x = screenFromPicture({stage.wipeColumn.value_or(0), 0}, framingOf(session, stage), area).x;
    if (stage.wipeColumn && x >= area.origin.x && x < area.origin.x + area.size.x) {
        ImGui::GetBackgroundDrawList()->AddLine({x, area.origin.y}, {x, area.origin.y + area.size.y},
                                                IM_COL32(255, 255, 255, 160), stage.scale);
    }
}

bool showStatus(const Session& session, const Loader* busy, const Stage& stage)
{
    const Area& area = stage.area;
    bool isCancelled = false;
    ImGui::SetNextWindowPos({0, area.size.y});
    ImGui::SetNextWindowSize({area.origin.x + area.size.x, stage.window.y - area.size.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8 * stage.scale, 2 * stage.scale});
    ImGui::Begin("status", nullptr, kFixed | ImGuiWindowFlags_NoScrollbar);
    if (busy != nullptr) {
        isCancelled = ImGui::SmallButton("Cancel"); // leftmost, where it stays whatever the name's length
        ImGui::SameLine();
        const float share = busy->share();
        const float waiting = static_cast<float>(std::fmod(ImGui::GetTime(), 1.0)); // goes round where it is not known
        ImGui::ProgressBar(share > 0 ? share : waiting, {160 * stage.scale, 0}, share > 0 ? nullptr : "");
        ImGui::SameLine();
        ImGui::TextUnformatted(busy->name().c_str());
    } else if (!session.message.empty()) {
        ImGui::TextUnformatted(session.message.c_str());
    } else {
        ImGui::TextDisabled("%d x %d   zoom %.0f %%   H: help", stage.picture.x, stage.picture.y,
                            static_cast<double>(100 * framingOf(session, stage).zoom));
    }
    ImGui::End();
    ImGui::PopStyleVar();
    return isCancelled;
}

} // namespace nacre
