#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace nacre {

// The light ball is a sphere seen from the camera; a light stands where the sphere faces it, so that the marker lies
// where the diffuse shading is brightest. `disc` is x right, y up, its rim at radius 1.

// Lights are dragged no further than this from the viewing direction: the visible side has to see them.
inline constexpr float kMostPolar = 1.48353f; // radians: 85 degrees

// What lies beyond the rim answers as the nearest point at kMostPolar.
glm::vec3 lightFromBallDisc(const glm::vec2& disc);

// The inverse; lights behind the rim stand on it. Any length.
glm::vec2 ballDiscFromLight(const glm::vec3& direction);

// A drag of (x right, y up, in radii of a ball) takes the light along.
glm::vec3 draggedLight(const glm::vec3& direction, const glm::vec2& moved);

// Of a light, in degrees: azimuth from x (right) to y (up) in the picture's plane, elevation above it, 90 where it
// stands behind the camera.
struct LightAngles {
    float azimuth = 0;
    float elevation = 90;
};
LightAngles anglesOf(const glm::vec3& direction);
glm::vec3 directionOf(const LightAngles& angles);

} // namespace nacre
