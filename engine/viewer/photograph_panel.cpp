#include <imgui.h>

#include "engine/viewer/panels.h"

namespace nacre {

namespace {

void chooseShown(Session& session, const Choices& choices)
{
    const bool isVerdicts = session.state.show == Show::verdicts;
    const auto choose = [&](const char* name, bool isChosen, Action action) {
        if (ImGui::RadioButton(name, isChosen) && !isChosen) {
            act(session, choices, action);
        }
    };
    // What brings the render back is what brought the other in its place.
    const Action back = isVerdicts                                     ? Action::verdicts
                        : session.comparison == Comparison::difference ? Action::difference
                                                                       : Action::photograph;
    const float second = ImGui::GetCursorPosX() + 0.45f * ImGui::GetContentRegionAvail().x;
    choose("Render", session.comparison == Comparison::none && !isVerdicts, back);
    besideIfItFits(second, "Photograph (P)");
    choose("Photograph (P)", session.comparison == Comparison::photograph, Action::photograph);
    choose("Verdicts (V)", isVerdicts, Action::verdicts);
    besideIfItFits(second, "Difference (X)");
    choose("Difference (X)", session.comparison == Comparison::difference, Action::difference);
}

void showLegend(std::span<const uint8_t> verdicts, float scale)
{
    const auto shares = verdictShares(verdicts);
    for (size_t i = 0; i < shares.size(); ++i) {
        const VerdictKind& kind = kVerdictKinds[i];
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float side = 0.7f * ImGui::GetFontSize(), drop = 0.2f * ImGui::GetFontSize();
        ImGui::GetWindowDrawList()->AddRectFilled(
            {at.x, at.y + drop}, {at.x + side, at.y + drop + side},
            ImGui::ColorConvertFloat4ToU32({kind.colour.r, kind.colour.g, kind.colour.b, 1}));
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + side + 8 * scale);
        ImGui::Text("%4.1f %% %s", 100 * shares[i], kind.name);
        ImGui::SameLine();
        ImGui::TextDisabled("%s", kind.meaning);
    }
}

} // namespace

void showPhotographPanel(Session& session, const PanelInputs& inputs)
{
    const std::vector<CapturedLight>& captured = inputs.choices.captured;
    if (captured.empty() || !ImGui::CollapsingHeader("Captured lights", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    if (ImGui::Button(" [ ")) {
        act(session, inputs.choices, Action::previousPhotograph);
    }
    ImGui::SameLine();
    if (ImGui::Button(" ] ")) {
        act(session, inputs.choices, Action::nextPhotograph);
    }
    ImGui::SameLine();
    if (session.photograph) {
        const size_t i = *session.photograph;
        ImGui::Text("%zu of %zu", i + 1, captured.size());
        ImGui::TextUnformatted(captured[i].photograph.c_str());
    } else {
        ImGui::TextDisabled("%zu lights", captured.size());
    }
    if (!session.hasPhotographs) {
        return;
    }
    chooseShown(session, inputs.choices);
    if (!inputs.verdicts.empty()) {
        showLegend(inputs.verdicts, inputs.scale);
    }
    if (!inputs.comparisonFigures.empty()) {
        ImGui::TextWrapped("%s", inputs.comparisonFigures.c_str());
    }
}

} // namespace nacre
