#include "acquisition/chain/material_blocks.h"

#include <algorithm>

namespace nacre {

namespace {

constexpr size_t kPixelsAtOnce = 16384;

template <class T> void append(std::vector<T>& to, const std::vector<T>& from, size_t place, size_t each)
{
    to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(place * each),
              from.begin() + static_cast<std::ptrdiff_t>((place + 1) * each));
}

BlockPart partOf(const Observations& block, const NormalBlock& normals, std::span<const glm::vec3> albedo,
                 const std::vector<size_t>& places)
{
    BlockPart part;
    part.places = places;
    part.seen.lightCount = block.lightCount;
    part.seen.width = block.width;
    part.seen.spacing = block.spacing;
    for (const size_t place : places) {
        part.seen.pixels.push_back(block.pixels[place]);
        append(part.seen.radiance, block.radiance, place, block.lightCount);
        append(part.seen.saturated, block.saturated, place, block.lightCount);
        if (!normals.pixels.empty()) {
            part.normals.pixels.push_back(normals.pixels[place]);
            append(part.normals.verdicts, normals.verdicts, place, block.lightCount);
        }
        if (!albedo.empty()) {
            part.albedo.push_back(albedo[place]);
        }
    }
    return part;
}

} // namespace

void forEachMaterial(const Observations& block, const NormalBlock& normals, std::span<const glm::vec3> albedo,
                     size_t materials, const std::function<size_t(uint32_t pixel)>& label,
                     const std::function<void(size_t material, const BlockPart& part)>& visit)
{
    for (size_t first = 0; first < block.pixels.size(); first += kPixelsAtOnce) {
        std::vector<std::vector<size_t>> places(materials);
        for (size_t p = first; p < std::min(block.pixels.size(), first + kPixelsAtOnce); ++p) {
            const size_t material = label(block.pixels[p]);
            if (material < materials) {
                places[material].push_back(p);
            }
        }
        for (size_t material = 0; material < materials; ++material) {
            if (!places[material].empty()) {
                visit(material, partOf(block, normals, albedo, places[material]));
            }
        }
    }
}

} // namespace nacre
