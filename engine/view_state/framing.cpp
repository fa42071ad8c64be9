#include "engine/view_state/framing.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace nacre {

namespace {

constexpr float kMostZoom = 64;         // screen pixels a pixel: single pixels are wide enough to read off
constexpr float kLeastOfFitted = 0.25f; // of the fitted zoom

} // namespace

float fittedZoom(const glm::vec2& picture, const Area& area)
{
    return std::max(std::min(area.size.x / picture.x, area.size.y / picture.y), 1e-3f);
}

Framing resolved(const Framing& framing, const glm::vec2& picture, const Area& area)
{
    return framing.zoom > 0 ? framing : Framing{.zoom = fittedZoom(picture, area), .centre = 0.5f * picture};
}

glm::vec2 pictureFromScreen(const glm::vec2& screen, const Framing& framing, const Area& area)
{
    return framing.centre + (screen - area.middle()) / framing.zoom;
}

glm::vec2 screenFromPicture(const glm::vec2& pixel, const Framing& framing, const Area& area)
{
    return area.middle() + (pixel - framing.centre) * framing.zoom;
}

Framing zoomed(const Framing& framing, float steps, const glm::vec2& cursor, const glm::vec2& picture, const Area& area)
{
    const Framing before = resolved(framing, picture, area);
    const float fitted = fittedZoom(picture, area);
    Framing after = before;
    after.zoom =
        std::clamp(before.zoom * std::pow(kZoomStep, steps), kLeastOfFitted * fitted, std::max(kMostZoom, fitted));
    const glm::vec2 kept = pictureFromScreen(cursor, before, area);
    after.centre = glm::clamp(kept - (cursor - area.middle()) / after.zoom, glm::vec2(0), picture);
    return after;
}

Framing panned(const Framing& framing, const glm::vec2& moved, const glm::vec2& picture, const Area& area)
{
    Framing after = resolved(framing, picture, area);
    after.centre = glm::clamp(after.centre - moved / after.zoom, glm::vec2(0), picture);
    return after;
}

} // namespace nacre
