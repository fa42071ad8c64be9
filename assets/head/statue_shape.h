#pragma once
#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace nacre {

// Distances to simple solids, negative inside, and ways of joining them (after Quilez, Distance Functions, 2008-2015).
// An ellipsoid's is a bound only near its surface; rays must step short of what these say.

inline float ellipsoid(const glm::vec3& p, const glm::vec3& radii)
{
    float k0 = glm::length(p / radii);
    float k1 = glm::length(p / (radii * radii));
    return k1 > 0.0f ? k0 * (k0 - 1.0f) / k1 : -std::min({radii.x, radii.y, radii.z});
}

inline float sphere(const glm::vec3& p, float radius)
{
    return glm::length(p) - radius;
}

// Round cone from a (radius ra) to b (radius rb), its sides taken straight.
inline float limb(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, float ra, float rb)
{
    glm::vec3 ab = b - a;
    float t = glm::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0f, 1.0f);
    return glm::length(p - a - ab * t) - glm::mix(ra, rb, t);
}

// Union whose seam is filled (or, for carved, cut) over a width of about k.
inline float joined(float a, float b, float k)
{
    float h = std::max(k - std::abs(a - b), 0.0f) / k;
    return std::min(a, b) - h * h * k * 0.25f;
}

inline float carved(float solid, float tool, float k)
{
    return -joined(-solid, tool, k);
}

inline float common(float a, float b, float k)
{
    return -joined(-a, -b, k);
}

inline glm::vec2 rotated(const glm::vec2& p, float angle)
{
    float c = std::cos(angle);
    float s = std::sin(angle);
    return {c * p.x - s * p.y, s * p.x + c * p.y};
}

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
