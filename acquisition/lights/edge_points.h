#pragma once
#include <vector>

#include <glm/vec2.hpp>

#include "engine/files/image.h"

namespace nacre {

// Where a picture changes most across a line.
struct EdgePoint {
    glm::vec2 at;        // image coordinates, see Circle
    glm::vec2 direction; // unit, towards the brighter side
    float strength;
};

// The picture with boxes of `box` x `box` pixels averaged to one; what is left over at the right and below is dropped.
Image boxAveraged(const Image& picture, int box);

// The `most` strongest of the points whose gradient is largest along its own direction (Canny, A computational approach
// to edge detection, 1986). `picture` has one channel.
std::vector<EdgePoint> strongestEdges(const Image& picture, size_t most);

// Bilinear, at image coordinates; the border's value beyond it.
float sampleAt(const Image& picture, const glm::dvec2& at);

} // namespace nacre
