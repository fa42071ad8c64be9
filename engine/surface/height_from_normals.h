#pragma once
#include <algorithm>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/files/image.h"
#include "engine/surface/normal_map.h"

namespace nacre {

// How much height rises a pixel to the right and a pixel up, of a surface seen from +z: p = -nx / nz, q = -ny / nz
// (Horn, "Robot Vision", 1986, ch. 10). Normals steeper than `leastZ` are taken to be that steep.
inline glm::vec2 slopeOfNormal(const glm::vec3& n, float leastZ)
{
    return glm::vec2(-n.x, -n.y) / std::max(n.z, leastZ);
}

struct IntegrationOptions {
    double tolerance = 1e-5; // of the equations' residual, relative
    int mostIterations = 300;
    int threads = 0; // 0 = all
};

struct IntegratedHeight {
    Image height;      // pixels towards the viewer; mean 0 over each piece, 0 where there is no normal
    size_t pieces = 0; // of pixels that touch, whose heights against each other are not known
    int iterations = 0;
    double residual = 0; // relative
};

// The height whose slopes fit those of the normals best: least squares over pairs of neighbouring pixels with data,
// weighted by confidence and by how well normals so steep tell a slope.
IntegratedHeight heightFromNormals(const NormalMap& normals, const IntegrationOptions& options = {});

} // namespace nacre
