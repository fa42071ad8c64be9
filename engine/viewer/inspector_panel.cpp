#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <imgui.h>

#include "engine/viewer/panels.h"
#include "engine/viewer/plots.h"

namespace nacre {

namespace {

constexpr int kLobeSamples = 181;  // a degree apart
constexpr float kPlotHeight = 110; // units of layout

const char* nameOfLabel(const Surface& surface, uint8_t label)
{
    return label < surface.materials.size() ? surface.materials[label].name.c_str() : "none";
}

void showLobe(const Session& session, const PanelInputs& inputs, const glm::vec3& n, const Material& material)
{
    if (session.light >= session.state.lights.size()) {
        return;
    }
    const float cosine = glm::dot(n, glm::normalize(session.state.lights[session.light].direction));
    const float incidence = std::acos(std::clamp(cosine, -1.0f, 1.0f)); // for the eye: rounding near 0 does no harm
    ImGui::Text("light %zu: n\xC2\xB7l %.3f, %.1f\xC2\xB0", session.light + 1, cosine, glm::degrees(incidence));
    if (cosine > 0) {
        plotLobe(sampleLobe(material.table, incidence, kLobeSamples), incidence, kPlotHeight * inputs.scale);
    } else {
        ImGui::TextDisabled("the light is below this pixel's horizon");
    }
}

// `pixel` of the surface that is drawn, which may be fitted into another size.
void showObservations(const PanelInputs& inputs, size_t pixel)
{
    const NormalMap& normals = inputs.drawn->surface.normals;
    const glm::ivec2 size = inputs.photographs->size();
    const int64_t from = fittedPixels(size.x, size.y, normals.width, normals.height)[pixel];
    const auto observations =
        from < 0 ? std::vector<PixelObservation>{} : inputs.photographs->observations(static_cast<size_t>(from));
    if (observations.empty()) {
        ImGui::TextDisabled("no observations here");
    } else {
        plotObservations(observations, kPlotHeight * inputs.scale);
    }
}

} // namespace

void showInspectorPanel(const Session& session, const PanelInputs& inputs)
{
    if (!ImGui::CollapsingHeader("Under the cursor", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    if (!inputs.pixel || inputs.drawn == nullptr) {
        ImGui::TextDisabled("point at the picture");
        return;
    }
    const Surface& surface = inputs.drawn->surface;
    const size_t i = surface.normals.index(inputs.pixel->x, inputs.pixel->y);
    const glm::vec3 n = surface.normals.normals[i];
    const uint8_t label = surface.labels.empty() ? Surface::kNoMaterial : surface.labels[i];
    ImGui::Text("pixel %d, %d", inputs.pixel->x, inputs.pixel->y);
    ImGui::Text("label %s", nameOfLabel(surface, label));
    if (surface.normals.confidence[i] <= 0) {
        ImGui::TextDisabled("no normal here");
        return;
    }
    ImGui::Text("normal %+.3f %+.3f %+.3f", n.x, n.y, n.z);
    ImGui::Text("%.1f\xC2\xB0 from the view", glm::degrees(std::atan2(glm::length(glm::vec2(n)), n.z)));
    ImGui::Text("confidence %.2f", surface.normals.confidence[i]);
    if (!surface.albedo.values.empty()) {
        const glm::vec3 a = surface.albedo.rgb(inputs.pixel->x, inputs.pixel->y);
        ImGui::Text("albedo %.2f %.2f %.2f", a.r, a.g, a.b);
    }
    if (label < surface.materials.size()) {
        showLobe(session, inputs, n, surface.materials[label]);
    }
    if (inputs.photographs != nullptr) {
        showObservations(inputs, i);
    }
}

} // namespace nacre
