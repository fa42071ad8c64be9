#pragma once
#include <glm/vec2.hpp>

#include "engine/view_state/framing.h"

namespace nacre {

// Where in a window so many pixels wide and high the panels lie, and what they leave for the picture. `scale` is pixels
// a unit of layout.
struct WindowLayout {
    glm::vec2 window{0, 0};
    float scale = 1;

    float inspectorWidth() const; // pixels, on the left
    float panelWidth() const;     // on the right
    Area area() const;            // between them, above the status line
    int ballSize() const;         // pixels across the ball of lights
    int thumbnailSize() const;    // of a material
    int shapeSize() const;        // of a shape's thumbnail
};

} // namespace nacre
