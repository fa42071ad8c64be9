#include "engine/view_state/picture_blit.h"

#include <algorithm>
#include <cmath>

namespace nacre {

namespace {

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
