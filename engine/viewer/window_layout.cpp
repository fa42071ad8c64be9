#include "engine/viewer/window_layout.h"

#include <algorithm>

#include <glm/common.hpp>

namespace nacre {
namespace {

// Units of layout; of narrow windows panels take a share.
constexpr float kPanelWidth = 300, kMostPanelShare = 0.4f;
constexpr float kInspectorWidth = 250, kMostInspectorShare = 0.3f;
constexpr float kStatusHeight = 26;
constexpr float kBallSize = 200;
constexpr float kThumbnailSize = 48;
constexpr float kShapeSize = 24; // a row of the panel

} // namespace

float WindowLayout::inspectorWidth() const
{
    return std::min(kInspectorWidth * scale, kMostInspectorShare * window.x);
}

float WindowLayout::panelWidth() const
{
    return std::min(kPanelWidth * scale, kMostPanelShare * window.x);
}

Area WindowLayout::area() const
{
    const glm::vec2 taken(panelWidth() + inspectorWidth(), kStatusHeight * scale);
    return {{inspectorWidth(), 0}, glm::max(window - taken, glm::vec2(1))};
}

int WindowLayout::ballSize() const
{
    return static_cast<int>(kBallSize * scale);
}

int WindowLayout::thumbnailSize() const
{
    return static_cast<int>(kThumbnailSize * scale);
}

int WindowLayout::shapeSize() const
{
    return static_cast<int>(kShapeSize * scale);
}

} // namespace nacre
