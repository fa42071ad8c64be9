#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <imgui.h>

#include "engine/scene/coverage.h"
#include "engine/viewer/panels.h"

namespace nacre {

namespace {

constexpr int kLobeSamples = 181;  // a degree apart
constexpr float kLeastLine = 2;    // pixels of a lobe's outline
constexpr float kPlotHeight = 110; // units of layout

constexpr ImU32 kAxis = IM_COL32(110, 110, 115, 255);
constexpr ImU32 kBack = IM_COL32(22, 22, 24, 255);

ImU32 colourOf(const glm::vec3& codes)
{
    return ImGui::ColorConvertFloat4ToU32({codes.r, codes.g, codes.b, 1});
}

// A dark box for a plot; answers its top left corner.
ImVec2 beginPlot(float width, float height)
{
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy({width, height});
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + width, at.y + height}, kBack, 3);
    return at;
}

float meanOf(const glm::vec3& f)
{
    return (f.r + f.g + f.b) / 3;
}

struct LobeSample {
    float angle = 0; // radians from the normal in the plane of incidence, positive on the side away from the light
    glm::vec3 f{0};  // 1/sr without the cosine
    bool isCertain = false;
};

// f(n, l, v) for light from `incidence` radians and `count` viewers over the plane of incidence, horizon to horizon.
std::vector<LobeSample> sampleLobe(const BrdfTable& table, float incidence, int count)
{
    const glm::vec3 n(0, 0, 1), l(-std::sin(incidence), 0, std::cos(incidence));
    std::vector<LobeSample> samples;
    for (int i = 0; i < count; ++i) {
        const float share = (static_cast<float>(i) + 0.5f) / static_cast<float>(count); // the horizons have no f
        const float angle = (2 * share - 1) * kHalfPi;
        const glm::vec3 v(std::sin(angle), 0, std::cos(angle));
        samples.push_back(
            {angle, evaluateTable(table, n, l, v).value, expectedError(table, n, l, v) <= kUncertainError});
    }
    return samples;
}

// Over the width of ImGui's window; `height` in pixels. The lobe about the normal (up), the light's direction as a
// line; what is uncertain is dim. The radius is f's mean over channels, relative to its largest value.
void plotLobe(std::span<const LobeSample> samples, float incidence, float height)
{
    const float width = ImGui::GetContentRegionAvail().x, margin = 0.08f * height;
    const ImVec2 at = beginPlot(width, height);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 foot(at.x + width / 2, at.y + height - margin);
    const float reach = std::min(width / 2, height - margin) - margin;
    const auto place = [&](float angle, float radius) {
        return ImVec2(foot.x + radius * std::sin(angle), foot.y - radius * std::cos(angle));
    };
    float largest = 1e-9f;
    for (const LobeSample& sample : samples) {
        largest = std::max(largest, meanOf(sample.f));
    }
    list.AddLine({foot.x - reach, foot.y}, {foot.x + reach, foot.y}, kAxis);
    list.AddLine(foot, place(0, reach), kAxis);
    list.AddLine(foot, place(-incidence, reach), IM_COL32(255, 214, 90, 255), 0.02f * height);
    const auto placeOf = [&](const LobeSample& sample) {
        return place(sample.angle, reach * meanOf(sample.f) / largest);
    };
    for (size_t first = 0, i = 1; i < samples.size(); ++i) {
        const bool isCertain = samples[i].isCertain && samples[first].isCertain;
        const ImVec2 from = placeOf(samples[first]), to = placeOf(samples[i]);
        const bool isLast = i + 1 == samples.size() || samples[i + 1].isCertain != samples[i].isCertain;
        if (isLast || std::hypot(to.x - from.x, to.y - from.y) > kLeastLine) { // many lie in one place
            list.AddLine(from, to, isCertain ? IM_COL32(120, 220, 140, 255) : IM_COL32(120, 220, 140, 90),
                         0.014f * height);
            first = i;
        }
    }
    ImGui::TextDisabled("f to %.3g / sr (dim: uncertain)", largest);
}

// Observations over n.l from 0 to 1, coloured by their verdict, and what the model predicts of each as a short line.
void plotObservations(std::span<const PixelObservation> observations, float height)
{
    const float width = ImGui::GetContentRegionAvail().x, margin = 0.06f * height, tick = 0.027f * height;
    const ImVec2 at = beginPlot(width, height);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    std::vector<float> values;
    for (const PixelObservation& o : observations) {
        values.push_back(std::max(o.observed, o.predicted));
    }
    const float largest = values.empty() ? 1.0f : std::max(*std::max_element(values.begin(), values.end()), 1e-6f);
    const auto place = [&](float nDotL, float value) {
        return ImVec2(at.x + margin + std::clamp(nDotL, 0.0f, 1.0f) * (width - 2 * margin),
                      at.y + height - margin - std::clamp(value / largest, 0.0f, 1.0f) * (height - 2 * margin));
    };
    list.AddLine(place(0, 0), place(1, 0), kAxis);
    list.AddLine(place(0, 0), place(0, largest), kAxis);
    for (const PixelObservation& o : observations) {
        const ImVec2 model = place(o.nDotL, o.predicted), dot = place(o.nDotL, o.observed);
        list.AddLine({model.x - tick, model.y}, {model.x + tick, model.y}, IM_COL32(120, 220, 140, 160), tick / 3);
        list.AddCircleFilled(dot, 0.75f * tick, colourOf(kVerdictKinds[o.verdict].colour));
    }
    ImGui::TextDisabled("I / E over n\xC2\xB7l; green: model");
    for (size_t i = 0; i < kVerdictKinds.size(); ++i) {
        const VerdictKind& kind = kVerdictKinds[i];
        const auto count = std::count_if(observations.begin(), observations.end(),
                                         [&](const PixelObservation& o) { return o.verdict == i; });
        if (count > 0) {
            ImGui::TextColored({kind.colour.r, kind.colour.g, kind.colour.b, 1}, "%d %s", static_cast<int>(count),
                               kind.name);
            ImGui::SameLine();
        }
    }
    ImGui::NewLine();
}

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

void showPixel(const Session& session, const PanelInputs& inputs)
{
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
    ImGui::PushTextWrapPos(0); // at the panel's edge
    showPixel(session, inputs);
    ImGui::PopTextWrapPos();
}

} // namespace nacre
