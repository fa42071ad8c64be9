#pragma once
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "assets/synth/bumpy_solid.h"
#include "engine/surface/normal_map.h"

namespace nacre {

// What a distant camera that looks along -z sees of a solid: pixel centres are sampled, so that every value is exact.
// The picture's shorter side spans [-1, 1]; x right, y up, the picture's middle is the origin.
struct OrthographicView {
    NormalMap normals;          // confidence 1 on the solid
    std::vector<double> depth;  // z of the surface; 0 beside the solid
    std::vector<uint8_t> mask;  // 1 on the solid
    std::vector<uint32_t> seen; // indices of the mask's pixels, ascending

    glm::dvec2 planePoint(uint32_t pixel) const;
    glm::dvec3 surfacePoint(uint32_t pixel) const { return {planePoint(pixel), depth[pixel]}; }
};

OrthographicView viewOf(const BumpySolid& solid, int width, int height, int threads);

} // namespace nacre
