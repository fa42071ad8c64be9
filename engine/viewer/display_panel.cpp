#include <array>
#include <utility>

#include <imgui.h>

#include "engine/viewer/panels.h"

namespace nacre {

namespace {

constexpr std::array kShown = {std::pair("Picture", Show::picture),   std::pair("Normals (N)", Show::normals),
                               std::pair("Labels (L)", Show::labels), std::pair("Coverage (C)", Show::coverage),
                               std::pair("theta h", Show::thetaH),    std::pair("theta d", Show::thetaD)};

constexpr std::array kResidual = {std::pair("on", ResidualUse::on), std::pair("off", ResidualUse::off),
                                  std::pair("alone", ResidualUse::alone)};

void chooseResidualShown(Session& session)
{
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Residual (D)");
    for (const auto& [name, use] : kResidual) {
        ImGui::SameLine();
        if (ImGui::RadioButton(name, session.state.residual == use)) {
            chooseResidual(session, use);
        }
    }
}

} // namespace

void showDisplayPanel(Session& session)
{
    if (!ImGui::CollapsingHeader("Display", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    ViewState& state = session.state;
    float stops = state.exposure.value_or(0);
    ImGui::PushItemWidth(-0.38f * ImGui::GetWindowWidth());
    if (ImGui::SliderFloat("Exposure", &stops, -8, 8, "%+.2f stops")) {
        state.exposure = stops;
    }
    ImGui::PopItemWidth();
    if (ImGui::Button("Automatic")) {
        state.exposure.reset();
    }
    ImGui::SameLine();
    bool filmic = state.toneCurve == kToneFilmic;
    if (ImGui::Checkbox("Filmic", &filmic)) {
        state.toneCurve = filmic ? kToneFilmic : kToneSrgb;
    }
    const float half = ImGui::GetCursorPosX() + 0.5f * ImGui::GetContentRegionAvail().x;
    for (size_t i = 0; i < kShown.size(); ++i) {
        if (ImGui::RadioButton(kShown[i].first, state.show == kShown[i].second)) {
            state.show = kShown[i].second;
            session.comparison = Comparison::none;
        }
        if (i % 2 == 0) {
            ImGui::SameLine(half);
        }
    }
    if (session.hasResidual) {
        chooseResidualShown(session);
    }
}

} // namespace nacre
