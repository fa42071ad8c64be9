#include <imgui.h>

#include "engine/viewer/panels.h"

namespace nacre {

namespace {

constexpr std::pair<const char*, const char*> kMouse[] = {
    {"drag on the ball", "move a light"}, {"right drag", "move the chosen light, anywhere"},
    {"drag", "move the picture"},         {"wheel", "zoom"},
    {"double click", "fit the picture"},  {"drop a file", "surface, material, normal map, environment"}};

void row(const char* keys, const char* text)
{
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(keys);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(text);
}

} // namespace

void showHelp(const glm::vec2& windowSize, float scale)
{
    ImGui::SetNextWindowPos({windowSize.x / 2, windowSize.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowBgAlpha(0.94f);
    const ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {18 * scale, 14 * scale});
    ImGui::Begin("help", nullptr, flags);
    ImGui::SetWindowFocus();
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const ActionHelp& help : actionHelp()) {
            row(help.keys, help.text);
        }
        row("", "");
        for (const auto& [mouse, text] : kMouse) {
            row(mouse, text);
        }
        ImGui::EndTable();
    }
    ImGui::End();
    ImGui::PopStyleVar();
}

} // namespace nacre
