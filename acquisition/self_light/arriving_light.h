#pragma once
#include <array>

#include "acquisition/self_light/self_light.h"

namespace nacre {

// Where a pixel is among the lattice's nodes and the patches.
struct Spot {
    glm::vec3 normal{0};         // unit; 0 where no node around has one
    std::array<int, 4> patches;  // the nearest ones
    std::array<float, 4> shares; // bilinear, of those that are there; all 0 where there is none
};
Spot spotOf(const SelfLight& self, uint32_t pixel, int width);

// K I / E of a pixel under each light, red, green, blue.
void arrivingAt(const SelfLight& self, const Spot& spot, std::vector<glm::vec3>& arriving);

// a of I / E = a (n.l + s K I / E), from the lights that a pixel faces. Shadows, which may be many, and highlights,
// which are few, hardly move it.
float selfLitAlbedo(std::span<const float> seen, std::span<const float> arriving, std::span<const float> cosines,
                    float strength);

} // namespace nacre
