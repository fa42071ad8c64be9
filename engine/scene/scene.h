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

// Linear radiance, 3 channels; 0 where there is no normal or no material.
using Frame = Image;

} // namespace nacre
