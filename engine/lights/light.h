#pragma once
#include <glm/vec3.hpp>

namespace nacre {

// A distant light in the camera frame (x right, y up, z towards the camera).
struct Light {
    glm::vec3 direction{0, 0, 1};  // unit, from the surface towards the light
    glm::vec3 irradiance{1, 1, 1}; // RGB on a plane that faces the light
    bool operator==(const Light&) const = default;
};

// Of the direction towards the viewer.
inline bool isFromTheFront(const glm::vec3& view)
{
    return view == glm::vec3(0, 0, 1);
}

} // namespace nacre
