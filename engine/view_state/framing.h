#pragma once
#include <vector>

#include <glm/vec2.hpp>

#include "engine/scene/scene_description.h"
#include "engine/surface/zoom.h"

namespace nacre {

// A part of the window in screen pixels, y down.
struct Area {
    glm::vec2 origin{0, 0};
    glm::vec2 size{0, 0};
    glm::vec2 middle() const { return origin + 0.5f * size; }
    bool holds(const glm::vec2& p) const
    {
        return p.x >= origin.x && p.y >= origin.y && p.x < origin.x + size.x && p.y < origin.y + size.y;
    }
};

// Screen pixels a pixel of the picture at which all of it is in the area.
float fittedZoom(const glm::vec2& picture, const Area& area);

// The framing with its numbers in place of "fitted".
Framing resolved(const Framing& framing, const glm::vec2& picture, const Area& area);

// Screen position to the picture's pixels and back. The framing is a resolved one.
glm::vec2 pictureFromScreen(const glm::vec2& screen, const Framing& framing, const Area& area);
glm::vec2 screenFromPicture(const glm::vec2& pixel, const Framing& framing, const Area& area);

// The whole screen pixels of the area on which the picture is seen, and the part of it that they show.
struct SeenPart {
    glm::ivec2 origin{0, 0};
    Zoom zoom; // of no size where nothing is seen
};
SeenPart seenPart(const glm::ivec2& picture, const Framing& framing, const Area& area);
// The part's column at which one of the picture begins.
int columnIn(const SeenPart& part, int column);

// What the wheel does: a step of 1 zooms in by kZoomStep; what is under the cursor stays there.
inline constexpr float kZoomStep = 1.189207f; // two to the fourth part of one
Framing zoomed(const Framing& framing, float steps, const glm::vec2& cursor, const glm::vec2& picture,
               const Area& area);

// What a drag does: the picture follows the cursor, until its middle would leave the area.
Framing panned(const Framing& framing, const glm::vec2& moved, const glm::vec2& picture, const Area& area);

// A rectangle of the picture and where it goes in the window, both in whole pixels, y down.
struct BlitRegion {
    glm::ivec2 from, fromEnd;
    glm::ivec2 to, toEnd;
};

// The columns [firstColumn, endColumn) of a picture as the framing (a resolved one) shows them in the area. Pixels that
// the area's border cuts are regions of their own: a copy may not leave the window, and stretched to what is left of
// it, a single pixel is still its own colour.
std::vector<BlitRegion> blitRegions(const glm::ivec2& picture, int firstColumn, int endColumn, const Framing& framing,
                                    const Area& area);

} // namespace nacre
