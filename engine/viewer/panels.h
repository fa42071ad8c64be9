#pragma once
#include <map>
#include <string>
#include <vector>

#include "engine/viewer/background_loads.h"
#include "engine/viewer/placed_picture.h"
#include "engine/viewer/session_input.h"
#include "engine/viewer/view_pictures.h"

namespace nacre {

// What panels read beside the session, and the pictures that they place among their controls.
struct PanelInputs {
    const Choices& choices;
    const std::map<std::string, Texture>& thumbnails;       // by MaterialChoice::specification
    const std::map<std::filesystem::path, Texture>& shapes; // by TargetChoice::path
    const Texture* ball = nullptr;                          // the material lit as the surface is
    const DrawnSurface* drawn = nullptr;
    std::span<const std::filesystem::path> recent; // surfaces, the newest first
    const Photographs* photographs = nullptr;      // once they are read
    std::span<const uint8_t> verdicts;             // that are shown
    std::optional<glm::ivec2> pixel;               // under the cursor, or the last that was
    std::string comparisonFigures;                 // of the photograph on screen
    float scale = 1;                               // pixels a unit of layout
    float shapeSize = 0;                           // pixels
};

// All of them: left and right of the picture, `width` the right ones'.
void showPanels(Session& session, const PanelInputs& inputs, const Stage& stage, float width,
                std::vector<PlacedPicture>& placed);
// Below the picture; `busy` is what is being read, or null, `hint` the opacity of what to do first, `remark` what there
// is to say of the picture. True where the user cancels what is read.
bool showStatus(const Session& session, const Loader* busy, const Stage& stage, float hint, const std::string& remark);
// Between the two pictures that a wipe shows.
void showWipeLine(const Session& session, const Stage& stage);

// Each describes its part of the panels left and right of the picture with ImGui, and changes the session where it is
// used.
void showLightPanel(Session& session, const PanelInputs& inputs, std::vector<PlacedPicture>& placed);
void showMaterialPanel(Session& session, const PanelInputs& inputs, std::vector<PlacedPicture>& placed);
void showDisplayPanel(Session& session);
void showRecentPanel(Session& session, const PanelInputs& inputs);
void showPhotographPanel(Session& session, const PanelInputs& inputs);
void showInspectorPanel(const Session& session, const PanelInputs& inputs);

// A slider whose value a double click types.
bool showValue(const char* label, float& value, float least, float most, const char* format,
               bool isLogarithmic = false);

// The next item, a button or box with this label, beside the last one, from `x` on in the panel, where it has room
// there.
void besideIfItFits(float x, const char* label);

// Over everything; what does not fit is scrolled to.
void showHelp(const glm::vec2& windowSize, float scale);

} // namespace nacre
