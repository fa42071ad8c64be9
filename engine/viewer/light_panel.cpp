#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <imgui.h>
#include <imgui_internal.h>

#include "engine/view_state/light_ball.h"
#include "engine/viewer/panels.h"

namespace nacre {

namespace {

constexpr float kMarkerRadius = 6;  // units of layout
constexpr float kMarkerReach = 12;  // of the cursor, to take a light
constexpr float kMostStrength = 16; // of irradiance's slider
constexpr const char* kDegrees = "%.0f\xC2\xB0";

// Where the ball stands on the screen.
struct BallPlace {
    glm::vec2 middle;
    float radius;

    glm::vec2 screenFromDisc(const glm::vec2& disc) const { return middle + radius * glm::vec2(disc.x, -disc.y); }
    glm::vec2 discFromScreen(const glm::vec2& p) const { return glm::vec2(p.x - middle.x, middle.y - p.y) / radius; }
};

// The light whose marker the cursor is on; the chosen one where it is on none.
size_t lightAt(const Session& session, const BallPlace& ball, const glm::vec2& cursor, float reach)
{
    size_t found = session.light;
    float nearest = reach;
    for (size_t i = 0; i < session.state.lights.size(); ++i) {
        const glm::vec2 marker = ball.screenFromDisc(ballDiscFromLight(session.state.lights[i].direction));
        if (glm::distance(marker, cursor) < nearest) {
            nearest = glm::distance(marker, cursor);
            found = i;
        }
    }
    return found;
}

void drawMarkers(const Session& session, const BallPlace& ball, float scale)
{
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (size_t i = 0; i < session.state.lights.size(); ++i) {
        const LightSource& light = session.state.lights[i];
        const glm::vec2 p = ball.screenFromDisc(ballDiscFromLight(light.direction));
        const bool isChosen = i == session.light;
        const ImU32 fill = !light.on ? IM_COL32(90, 90, 90, 255) : IM_COL32(255, 214, 90, 255);
        list.AddCircleFilled({p.x, p.y}, kMarkerRadius * scale, fill);
        list.AddCircle({p.x, p.y}, (kMarkerRadius + 1) * scale,
                       isChosen ? IM_COL32(255, 255, 255, 255) : IM_COL32(0, 0, 0, 255), 0,
                       isChosen ? 2 * scale : scale);
        const std::string number = std::to_string(i + 1);
        const ImVec2 size = ImGui::CalcTextSize(number.c_str());
        const float small = 0.75f;
        list.AddText(ImGui::GetFont(), small * ImGui::GetFontSize(),
                     {p.x - small * size.x / 2, p.y - small * size.y / 2}, IM_COL32(0, 0, 0, 255), number.c_str());
    }
}

void showBall(Session& session, const PanelInputs& inputs, std::vector<PlacedPicture>& placed)
{
    const auto size = static_cast<float>(inputs.ball->extent().width);
    const float indent = 0.5f * (ImGui::GetContentRegionAvail().x - size);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(indent, 0.0f));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const BallPlace ball{{at.x + size / 2, at.y + size / 2}, size / 2};
    ImGui::InvisibleButton("ball", {size, size});
    ImGui::SetItemUsingMouseWheel(); // which else scrolls the panel
    const glm::vec2 cursor(ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y);
    if (ImGui::IsItemActivated()) {
        session.light = lightAt(session, ball, cursor, kMarkerReach * inputs.scale);
    }
    if (ImGui::IsItemActive()) {
        session.playing = false;
        pointLight(session, ball.discFromScreen(cursor));
    } else if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("Drag: the light goes along\nWheel: away, nearer");
        pushLight(session, ImGui::GetIO().MouseWheel);
    }
    const ImVec2 low = ImGui::GetWindowDrawList()->GetClipRectMin(),
                 high = ImGui::GetWindowDrawList()->GetClipRectMax();
    placed.push_back(
        placedPicture(*inputs.ball, {{at.x, at.y}, {size, size}}, {{low.x, low.y}, {high.x - low.x, high.y - low.y}}));
    drawMarkers(session, ball, inputs.scale);
}

void showList(Session& session)
{
    for (size_t i = 0; i < session.state.lights.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        LightSource& light = session.state.lights[i];
        ImGui::Checkbox("##on", &light.on);
        ImGui::SameLine();
        const glm::vec3 d = glm::normalize(light.direction);
        const std::string place = std::isfinite(light.distance) ? fmt::format("  at {:.1f}", light.distance) : "";
        const std::string name = light.captured > 0
                                     ? fmt::format("{}  captured {}", i + 1, light.captured)
                                     : fmt::format("{}  {:+.2f} {:+.2f} {:+.2f}{}", i + 1, d.x, d.y, d.z, place);
        if (ImGui::Selectable(name.c_str(), i == session.light)) {
            session.light = i;
        }
        ImGui::PopID();
    }
    if (ImGui::Button("Add light")) {
        addLight(session);
    }
    if (session.state.lights.size() > 1 || (!session.state.environment.empty() && !session.state.lights.empty())) {
        ImGui::SameLine();
        if (ImGui::Button("Remove")) {
            removeLight(session);
        }
    }
}

// Where it stands. Towards azimuths nothing shows at an elevation of 90 degrees.
void showAngles(LightSource& light)
{
    LightAngles angles = anglesOf(light.direction);
    const bool isTurned = showValue("Azimuth", angles.azimuth, -180, 180, kDegrees);
    if (showValue("Elevation", angles.elevation, -90, 90, kDegrees) || isTurned) {
        light.direction = directionOf(angles);
        light.captured = 0;
    }
}

// Irradiance as a colour, whose largest channel is 1, and a strength.
void showChosen(LightSource& light)
{
    const float strength = std::max({light.irradiance.r, light.irradiance.g, light.irradiance.b});
    glm::vec3 colour = strength > 0 ? light.irradiance / strength : glm::vec3(1);
    float wanted = strength;
    besideIfItFits(ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + ImGui::GetStyle().ItemSpacing.x, "Colour");
    bool changed = ImGui::ColorEdit3("Colour", &colour.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoInputs);
    ImGui::PushItemWidth(-0.38f * ImGui::GetWindowWidth());
    showAngles(light);
    changed |= showValue("Strength", wanted, 0, kMostStrength, "%.2f", true);
    if (changed) {
        const float largest = std::max({colour.r, colour.g, colour.b, 1e-3f});
        light.irradiance = glm::max(wanted, 0.0f) * colour / largest;
        light.captured = 0;
    }
    float soft = light.softDegrees;
    if (showValue("Softness", soft, 0, 45, kDegrees)) {
        light.softDegrees = std::round(std::clamp(soft, 0.0f, 90.0f));
    }
    ImGui::PopItemWidth();
}

void showEnvironments(Session& session, const Choices& choices)
{
    const std::filesystem::path& chosen = session.state.environment;
    ImGui::PushItemWidth(-0.38f * ImGui::GetWindowWidth());
    if (ImGui::BeginCombo("Environment", chosen.empty() ? "none" : chosen.stem().c_str())) {
        if (ImGui::Selectable("none", chosen.empty())) {
            chooseEnvironment(session, choices, {});
        }
        for (size_t i = 0; i < choices.environments.size(); ++i) {
            if (ImGui::Selectable(choices.environments[i].stem().c_str(), chosen == choices.environments[i])) {
                chooseEnvironment(session, choices, i);
            }
        }
        ImGui::EndCombo();
    }
    if (!chosen.empty()) {
        showValue("Turn", session.state.environmentTurn, -180, 180, kDegrees);
    }
    ImGui::PopItemWidth();
}

} // namespace

void showLightPanel(Session& session, const PanelInputs& inputs, std::vector<PlacedPicture>& placed)
{
    if (!ImGui::CollapsingHeader("Lights", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    if (inputs.ball != nullptr) {
        showBall(session, inputs, placed);
    }
    showList(session);
    if (session.light < session.state.lights.size()) {
        showChosen(session.state.lights[session.light]);
    }
    if (!inputs.choices.environments.empty()) {
        showEnvironments(session, inputs.choices);
    }
}

} // namespace nacre
