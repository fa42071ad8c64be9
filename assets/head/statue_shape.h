#pragma once
#include <cmath>

#include <glm/vec3.hpp>

namespace nacre {

// Distances of the bust's parts. The head's frame: origin between the ears, y up, z out of the face; the chin lies at
// about y = -0.9 and the crown at 1.05. Parts are mirror images about x = 0, save for the hair.

// |x| without the kink at 0, which would show as a seam.
inline float foldedX(float x)
{
    constexpr float kRounding = 0.03f;
    return std::sqrt(x * x + kRounding * kRounding) - kRounding;
}

float faceDistance(const glm::vec3& p);
float hairDistance(const glm::vec3& p);
// The bust's frame: the head's, upright and not turned.
float bustDistance(const glm::vec3& p);
// Whether a point of the bust's surface lies on the cloak.
bool onCloak(const glm::vec3& p);

} // namespace nacre
