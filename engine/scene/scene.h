#pragma once
#include <vector>

#include "engine/files/image.h"
#include "engine/surface/surface.h"

namespace nacre {

// What a frame shows.
struct Scene {
    Surface surface;
    std::vector<Light> lights;
    glm::vec3 view{0, 0, 1}; // unit, towards the distant viewer
};

// direct: per pixel and light one lookup of the material's table; any view. ball: per pixel one lookup of the
// material's ball, which holds all lights; v = (0,0,1) only. automatic: ball where every material's ball is small
// enough and the view is from the front.
enum class RenderPath { automatic, direct, ball };

// Linear radiance, 3 channels; 0 where there is no normal or no material.
using Frame = Image;

} // namespace nacre
