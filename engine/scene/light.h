#pragma once
#include <glm/vec3.hpp>

namespace nacre {

// A distant light in the camera frame (x right, y up, z towards the camera).
struct Light {
    glm::vec3 direction{0, 0, 1};  // unit, from the surface towards the light
    glm::vec3 irradiance{1, 1, 1}; // RGB on a plane that faces the light
    bool operator==(const Light&) const = default;
};

} // namespace nacre
