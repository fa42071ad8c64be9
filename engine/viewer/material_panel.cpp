#include <algorithm>

#include <imgui.h>

#include "engine/viewer/panels.h"

namespace nacre {

namespace {

void showWipe(Session& session, const PanelInputs& inputs, size_t index, bool isWiped, const ImVec2& size)
{
    if (ImGui::Selectable("wipe", isWiped, 0, size)) {
        if (isWiped) {
            session.state.wipe = {};
        } else {
            chooseWipe(session, inputs.choices, index);
        }
    }
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("This material right of a line that can be dragged");
    }
}

// In the square of this side at the cursor, as far as the panel shows it.
void placeThumbnail(const Texture& picture, const ImVec2& at, float side, std::vector<PlacedPicture>& placed)
{
    const ImVec2 low = ImGui::GetWindowDrawList()->GetClipRectMin();
    const ImVec2 high = ImGui::GetWindowDrawList()->GetClipRectMax();
    const auto width = static_cast<float>(picture.extent().width), height = static_cast<float>(picture.extent().height);
    const glm::vec2 size = side / std::max(width, height) * glm::vec2(width, height);
    placed.push_back(placedPicture(picture, {{at.x, at.y}, size}, {{low.x, low.y}, {high.x - low.x, high.y - low.y}}));
    placed.back().isStill = true;
}

void showMaterial(Session& session, const PanelInputs& inputs, size_t index, bool isChosen,
                  std::vector<PlacedPicture>& placed)
{
    const MaterialChoice& choice = inputs.choices.materials[index];
    const auto found = inputs.thumbnails.find(choice.specification);
    const float side = 32 * inputs.scale;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy({side, side});
    if (found != inputs.thumbnails.end()) {
        placeThumbnail(found->second, at, side, placed);
    }
    ImGui::SameLine();
    const std::string name = std::to_string(index + 1) + "  " + choice.name;
    const bool isWiped = session.state.wipe.material == specificationOf(inputs.choices, index);
    const bool canWipe = inputs.choices.materials.size() > 1;
    const float wipeWidth = canWipe ? 52 * inputs.scale : 0.0f;
    ImGui::PushStyleVar(ImGuiStyleVar_SelectableTextAlign, {0, 0.5f});
    if (ImGui::Selectable(name.c_str(), isChosen, 0, {ImGui::GetContentRegionAvail().x - wipeWidth, side})) {
        chooseMaterial(session, inputs.choices, index);
    }
    if (canWipe) {
        ImGui::SameLine();
        showWipe(session, inputs, index, isWiped, {0.8f * wipeWidth, side});
    }
    ImGui::PopStyleVar();
}

// Shapes that have been shown have a thumbnail at the right of their column, `right`.
void showShape(Session& session, const PanelInputs& inputs, size_t index, bool isChosen, float right,
               std::vector<PlacedPicture>& placed)
{
    const TargetChoice& choice = inputs.choices.targets[index];
    const float side = inputs.shapeSize;
    if (ImGui::RadioButton(choice.name.c_str(), isChosen)) {
        chooseTarget(session, inputs.choices, index);
    }
    const auto found = inputs.shapes.find(choice.path);
    const float x = ImGui::GetWindowPos().x + right - side;
    if (found != inputs.shapes.end() && ImGui::GetItemRectMax().x <= x) { // names come first
        placeThumbnail(found->second, {x, ImGui::GetItemRectMin().y}, side, placed);
    }
}

} // namespace

void showMaterialPanel(Session& session, const PanelInputs& inputs, std::vector<PlacedPicture>& placed)
{
    if (!ImGui::CollapsingHeader("Materials", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    const auto chosen = chosenMaterial(session.state, inputs.choices);
    for (size_t i = 0; i < inputs.choices.materials.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        showMaterial(session, inputs, i, chosen == i, placed);
        ImGui::PopID();
    }
    if (inputs.choices.targets.size() > 1) {
        ImGui::TextDisabled("on the shape of (T)");
        const auto target = chosenTarget(session.state, inputs.choices);
        const float half = ImGui::GetCursorPosX() + 0.5f * ImGui::GetContentRegionAvail().x;
        const float gap = ImGui::GetStyle().ItemSpacing.x;
        for (size_t i = 0; i < inputs.choices.targets.size(); ++i) {
            ImGui::PushID(static_cast<int>(i) + 1000);
            if (i % 2 == 1 && ImGui::GetItemRectMax().x < ImGui::GetWindowPos().x + half) {
                besideIfItFits(half, inputs.choices.targets[i].name.c_str());
            }
            const bool isLeft = ImGui::GetCursorPosX() < half;
            const float right = isLeft ? half - gap : ImGui::GetWindowContentRegionMax().x;
            showShape(session, inputs, i, target == i, right, placed);
            ImGui::PopID();
        }
    }
}

} // namespace nacre
