#pragma once
#include <algorithm>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace nacre {

// How much height rises a pixel to the right and a pixel up, of a surface seen from +z: p = -nx / nz, q = -ny / nz
// (Horn, "Robot Vision", 1986, ch. 10). Normals steeper than `leastZ` are taken to be that steep.
inline glm::vec2 slopeOfNormal(const glm::vec3& n, float leastZ)
{
    return glm::vec2(-n.x, -n.y) / std::max(n.z, leastZ);
}

} // namespace nacre
