#include "engine/viewer/plots.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

namespace nacre {

namespace {

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

} // namespace

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
    for (size_t i = 0; i + 1 < samples.size(); ++i) {
        const bool isMeasured = samples[i].isMeasured && samples[i + 1].isMeasured;
        list.AddLine(place(samples[i].angle, reach * meanOf(samples[i].f) / largest),
                     place(samples[i + 1].angle, reach * meanOf(samples[i + 1].f) / largest),
                     isMeasured ? IM_COL32(120, 220, 140, 255) : IM_COL32(120, 220, 140, 90), 0.014f * height);
    }
    ImGui::TextDisabled("f to %.3g / sr (dim: guessed)", largest);
}

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

} // namespace nacre
