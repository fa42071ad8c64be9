#include <imgui.h>

#include "engine/viewer/panels.h"

namespace nacre {

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
    const auto choose = [&](const char* name, Comparison comparison) {
        if (ImGui::RadioButton(name, session.comparison == comparison) && session.comparison != comparison) {
            const Action action = comparison == Comparison::difference || (comparison == Comparison::none &&
                                                                           session.comparison == Comparison::difference)
                                      ? Action::difference
                                      : Action::photograph;
            act(session, inputs.choices, action);
        }
    };
    choose("Render", Comparison::none);
    choose("Photograph (P)", Comparison::photograph);
    choose("Difference (X)", Comparison::difference);
    if (!inputs.comparisonFigures.empty()) {
        ImGui::TextWrapped("%s", inputs.comparisonFigures.c_str());
    }
}

} // namespace nacre
