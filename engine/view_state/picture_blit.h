#pragma once
#include <vector>

#include <glm/vec2.hpp>

#include "engine/view_state/framing.h"

namespace nacre {

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
