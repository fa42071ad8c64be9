#pragma once
#include <vector>

#include <glm/vec2.hpp>

#include "engine/surface/surface.h"

namespace nacre {

// A part of a picture at another scale.
struct Zoom {
    float scale = 1;        // pixels a pixel of the picture
    glm::vec2 origin{0, 0}; // of the part's top left corner, in pixels of the picture
    glm::ivec2 size{0, 0};  // of the part, in its own pixels
    bool operator==(const Zoom&) const = default;
    bool magnifies() const { return scale > 1; }
};

// All of a picture.
Zoom wholeZoom(int width, int height, float scale);

// A surface's pixels between its own: normals, factors and all else that pixels have, bilinear between the neighbours
// of the material that has most of the place, as far as they lie on one surface.
struct MagnifiedSurface {
    Surface pixels; // without materials and heights
    // Share of each that the object covers, / 255: its outline is where half of the neighbours are.
    std::vector<uint8_t> cover;
};
MagnifiedSurface magnified(const Surface& surface, const Zoom& zoom, int threads = 0);

// What a magnified surface shows, less where it covers less: of codes, n/255 (shaders/shared/zoom.h), or of radiance.
Image coveredCodes(const Image& codes, const std::vector<uint8_t>& cover);
Image coveredRadiance(const Image& radiance, const std::vector<uint8_t>& cover);

// The mean over each pixel's share of a picture that is reduced: of codes, n/255 (shaders/shared/zoom.h), or of
// radiance.
Image reducedCodes(const Image& codes, const Zoom& zoom);
Image reducedRadiance(const Image& radiance, const Zoom& zoom);

} // namespace nacre
