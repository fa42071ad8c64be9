#pragma once
#include <map>
#include <string>
#include <vector>

#include "engine/viewer/controls.h"
#include "engine/viewer/photographs.h"
#include "engine/viewer/placed_picture.h"
#include "engine/viewer/view_pictures.h"

namespace nacre {

// What panels read beside the session, and the pictures that they place among their controls.
struct PanelInputs {
    const Choices& choices;
    const std::map<std::string, Texture>& thumbnails; // by MaterialChoice::specification
    const Texture* ball = nullptr;                    // the material lit as the surface is
    const DrawnSurface* drawn = nullptr;
    const Photographs* photographs = nullptr; // once they are read
    std::span<const uint8_t> verdicts;        // that are shown
    std::optional<glm::ivec2> pixel;          // under the cursor, or the last that was
    std::string comparisonFigures;            // of the photograph on screen
    float scale = 1;                          // pixels a unit of layout
};

// Each describes its part of the panels left and right of the picture with ImGui, and changes the session where it is
// used.
void showLightPanel(Session& session, const PanelInputs& inputs, std::vector<PlacedPicture>& placed);
void showMaterialPanel(Session& session, const PanelInputs& inputs, std::vector<PlacedPicture>& placed);
void showDisplayPanel(Session& session, const PanelInputs& inputs);
void showPhotographPanel(Session& session, const PanelInputs& inputs);
void showInspectorPanel(const Session& session, const PanelInputs& inputs);

// Over everything.
void showHelp(const glm::vec2& windowSize, float scale);

} // namespace nacre
