#include "engine/viewer/panels.h"

#include <array>
#include <cmath>
#include <utility>

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

constexpr std::pair<const char*, const char*> kMouse[] = {
    {"drag on the ball", "move a light"},
    {"right drag", "move the chosen light, anywhere"},
    {"drag", "move the picture"},
    {"wheel", "zoom"},
    {"Shift or middle drag", "turn the object"},
    {"double click", "fit the picture; on a value, type it"},
    {"drop a file", "surface, material, normal map, environment"}};

void row(const char* keys, const char* text)
{
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(keys);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(text);
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
    showRecentPanel(session, inputs);
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

bool showValue(const char* label, float& value, float least, float most, const char* format, bool isLogarithmic)
{
    const float before = value;
    const bool isChanged = ImGui::SliderFloat(label, &value, least, most, format,
                                              isLogarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
    float& beforeClick = *ImGui::GetStateStorage()->GetFloatRef(ImGui::GetItemID(), before);
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        value = beforeClick; // the first of the two has moved the slider
        ImGui::SetKeyboardFocusHere(-1);
        return true;
    }
    if (ImGui::IsItemActivated()) {
        beforeClick = before;
    }
    return isChanged;
}

void besideIfItFits(float x, const char* label)
{
    const float width = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x + ImGui::CalcTextSize(label).x;
    if (x + width <= ImGui::GetWindowContentRegionMax().x) {
        ImGui::SameLine(x);
    }
}

bool showStatus(const Session& session, const Loader* busy, const Stage& stage, float hint, const std::string& remark)
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
    } else if (hint > 0) {
        ImGui::PushStyleVar(ImGuiStyleVar_Alpha, hint);
        ImGui::TextUnformatted("Drag on the ball of lights, or with the right button anywhere. H: help");
        ImGui::PopStyleVar();
    } else {
        ImGui::TextDisabled("%d x %d   zoom %.0f %%   H: help   %s", stage.picture.x, stage.picture.y,
                            static_cast<double>(100 * framingOf(session, stage).zoom), remark.c_str());
    }
    ImGui::End();
    ImGui::PopStyleVar();
    return isCancelled;
}

void showDisplayPanel(Session& session)
{
    if (!ImGui::CollapsingHeader("Display", ImGuiTreeNodeFlags_DefaultOpen)) {
        return;
    }
    ViewState& state = session.state;
    float stops = state.exposure.value_or(0);
    ImGui::PushItemWidth(-0.38f * ImGui::GetWindowWidth());
    if (showValue("Exposure", stops, -8, 8, "%+.2f stops")) {
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
        if (i % 2 == 1) {
            besideIfItFits(half, kShown[i].first);
        }
        if (ImGui::RadioButton(kShown[i].first, state.show == kShown[i].second)) {
            state.show = kShown[i].second;
            session.comparison = Comparison::none;
        }
    }
    if (session.hasResidual) {
        chooseResidualShown(session);
    }
}

void showRecentPanel(Session& session, const PanelInputs& inputs)
{
    const bool isOpen = inputs.choices.surface.empty(); // where there is nothing else to look at
    if (inputs.recent.empty() ||
        !ImGui::CollapsingHeader("Recent", isOpen ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None)) {
        return;
    }
    for (const std::filesystem::path& file : inputs.recent) {
        ImGui::PushID(file.c_str());
        if (ImGui::Selectable(file.stem().c_str(), file == inputs.choices.surface)) {
            session.wantsToOpen = file;
        }
        if (ImGui::IsItemHovered()) {
            ImGui::SetTooltip("%s", file.c_str());
        }
        ImGui::PopID();
    }
}

void showHelp(const glm::vec2& windowSize, float scale)
{
    ImGui::SetNextWindowPos({windowSize.x / 2, windowSize.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowBgAlpha(0.94f);
    ImGui::SetNextWindowSizeConstraints({0, 0}, {windowSize.x, windowSize.y});
    const ImGuiWindowFlags flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize |
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
