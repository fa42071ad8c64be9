#pragma once
#include <glm/vec2.hpp>

#include "engine/files/image.h"
#include "engine/surface/normal_map.h"

namespace nacre {

// A thinned part of a picture: pixel (x, y) of it stands for the square of `spacing` pixels from `origin` +
// (x, y) * spacing, of which it is the middle one.
struct Thinning {
    int spacing = 1;
    glm::ivec2 origin{0};

    glm::ivec2 middleOf(int x, int y) const { return origin + glm::ivec2(x, y) * spacing + spacing / 2; }
};

// The height of a map of normals whose steps are those of a thinned one, which has a height of its own pixels. Between
// its pixels the height is the normals' own.
Image fullHeight(const NormalMap& normals, const NormalMap& thinned, const Image& height, const Thinning& thinning,
                 int threads);

} // namespace nacre
