#include "engine/view_state/framing.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace nacre {
namespace {

constexpr float kMostZoom = 64;         // screen pixels a pixel: single pixels are wide enough to read off
constexpr float kLeastOfFitted = 0.25f; // of the fitted zoom

struct Span {
    int from, fromEnd, to, toEnd;
};

// Along one axis: pixels [first, end) at origin + zoom * pixel, cut to [low, high) of the screen.
std::vector<Span> spansAlong(int first, int end, float origin, float zoom, float low, float high)
{
    const auto screen = [&](int pixel) { return origin + zoom * static_cast<float>(pixel); };
    const auto cut = [&](float position) { return static_cast<int>(std::lround(std::clamp(position, low, high))); };
    const int firstSeen = std::clamp(static_cast<int>(std::floor((low - origin) / zoom)), first, end);
    const int endSeen = std::clamp(static_cast<int>(std::ceil((high - origin) / zoom)), firstSeen, end);
    if (firstSeen == endSeen) {
        return {};
    }
    const int firstWhole = screen(firstSeen) < low ? firstSeen + 1 : firstSeen;
    const int endWhole = std::max(firstWhole, screen(endSeen) > high ? endSeen - 1 : endSeen);
    std::vector<Span> spans;
    for (const auto& [a, b] :
         {std::pair(firstSeen, firstWhole), std::pair(firstWhole, endWhole), std::pair(endWhole, endSeen)}) {
        const Span span{a, b, cut(screen(a)), cut(screen(b))};
        if (a < b && span.to < span.toEnd) {
            spans.push_back(span);
        }
    }
    return spans;
}

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

SeenPart seenPart(const glm::ivec2& picture, const Framing& framing, const Area& area)
{
    const glm::vec2 first = glm::round(glm::max(area.origin, screenFromPicture({0, 0}, framing, area)));
    const glm::vec2 end = glm::round(glm::min(area.origin + area.size, screenFromPicture(picture, framing, area)));
    return {.origin = first,
            .zoom = {.scale = framing.zoom,
                     .origin = pictureFromScreen(first, framing, area),
                     .size = glm::max(end - first, glm::vec2(0))}};
}

int columnIn(const SeenPart& part, int column)
{
    const float x = (static_cast<float>(column) - part.zoom.origin.x) * part.zoom.scale;
    return std::clamp(static_cast<int>(std::lround(x)), 0, part.zoom.size.x);
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

std::vector<BlitRegion> blitRegions(const glm::ivec2& picture, int firstColumn, int endColumn, const Framing& framing,
                                    const Area& area)
{
    const glm::vec2 origin = screenFromPicture({0, 0}, framing, area), end = area.origin + area.size;
    std::vector<BlitRegion> regions;
    for (const Span& y : spansAlong(0, picture.y, origin.y, framing.zoom, area.origin.y, end.y)) {
        for (const Span& x : spansAlong(firstColumn, endColumn, origin.x, framing.zoom, area.origin.x, end.x)) {
            regions.push_back({{x.from, y.from}, {x.fromEnd, y.fromEnd}, {x.to, y.to}, {x.toEnd, y.toEnd}});
        }
    }
    return regions;
}

} // namespace nacre
