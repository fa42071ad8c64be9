#pragma once
#include <limits>

#include <glm/vec3.hpp>

namespace nacre {

// In the camera frame (x right, y up, z towards the camera), as the object's middle meets it.
struct Light {
    glm::vec3 direction{0, 0, 1};                            // unit, from the surface towards the light
    glm::vec3 irradiance{1, 1, 1};                           // RGB on a plane that faces the light
    float distance = std::numeric_limits<float>::infinity(); // in widths of the object (object_places.h)
    bool operator==(const Light&) const = default;
};

// Nearer lights stand inside the object.
inline constexpr double kNearestLight = 0.6; // widths
// From here on a light is drawn as a distant one: over the object its irradiance changes by less than a step of eight
// bits, its direction by a tenth of a degree.
inline constexpr float kDistantFrom = 256;

inline bool isNear(const Light& light)
{
    return light.distance < kDistantFrom;
}

// Directions towards the viewer.
inline constexpr glm::vec3 kFrontView{0, 0, 1};

inline bool isFromTheFront(const glm::vec3& view)
{
    return view == kFrontView;
}

} // namespace nacre
