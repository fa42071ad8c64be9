#pragma once
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/surface/normal_map.h"

namespace nacre {

// A piece of a surface, as light between such pieces sees it: flat. Lengths in pixels of the normal map, camera frame.
struct Patch {
    glm::vec3 position{0};
    glm::vec3 normal{0};
    float area = 0;
};

constexpr int kPatchSide = 2; // pixels of the normal map

// A height field of patches, one for each square of kPatchSide pixels that has a normal.
struct PatchGrid {
    int width = 0;
    int height = 0;
    std::vector<int> index; // width x height: the patch there, -1 for none
    std::vector<Patch> patches;
};

// Heights are those that fit the normals best; each connected piece of the map has its own zero.
PatchGrid makePatches(const NormalMap& normals, int threads);

// Light that arrives at a patch from another: towards it, as long as the form factor over the receiver's cosine, so
// that the form factor of a receiver with normal n is n . flow.
struct Passage {
    uint32_t from = 0;
    glm::vec3 flow{0};
};

// For each patch those that it sees: both face each other, and no patch between them stands higher than the ray. The
// form factors of a patch add up to at most 1.
std::vector<std::vector<Passage>> passagesBetween(const PatchGrid& grid, int threads);

} // namespace nacre
