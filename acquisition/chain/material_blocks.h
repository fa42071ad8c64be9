#pragma once
#include <functional>
#include <span>

#include "acquisition/capture/observations.h"
#include "acquisition/normals/normals.h"

namespace nacre {

// Some pixels of a block; normals and albedo factors are empty where the block came without.
struct BlockPart {
    std::vector<size_t> places; // in the block
    Observations seen;
    NormalBlock normals;
    std::vector<glm::vec3> albedo;
};

// Cuts a block of all materials into parts of one: visit(material, part). A part's size is bounded, so that no second
// copy of a large block is held, and parts of a material come in the pixels' order. `label` answers a pixel's material,
// anything from `materials` on for none.
void forEachMaterial(const Observations& block, const NormalBlock& normals, std::span<const glm::vec3> albedo,
                     size_t materials, const std::function<size_t(uint32_t pixel)>& label,
                     const std::function<void(size_t material, const BlockPart& part)>& visit);

} // namespace nacre
