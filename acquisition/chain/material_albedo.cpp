#include "acquisition/chain/material_albedo.h"

#include <algorithm>

#include "acquisition/chain/material_blocks.h"
#include "acquisition/normals/smooth_fill.h"

namespace nacre {

namespace {

// The picture where `take` says so, 0 (no data) elsewhere.
Image keptWhere(const Image& albedo, const std::vector<uint8_t>& take)
{
    Image kept(albedo.width, albedo.height, 3);
    for (size_t i = 0; i < take.size(); ++i) {
        if (take[i]) {
            std::copy_n(&albedo.values[3 * i], 3, &kept.values[3 * i]);
        }
    }
    return kept;
}

glm::vec3 finishOne(const Capture& capture, const std::vector<uint8_t>& object, BrdfTable& table, Image& albedo)
{
    if (!capture.smooth.empty()) {
        fillSmoothly(albedo, capture.smooth, object);
    }
    return normaliseAlbedo(albedo, table);
}

} // namespace

void refitAlbedo(const Observations& block, const NormalMap& normals, const LocalLights& lights,
                 std::span<const uint8_t> labels, std::span<BrdfTable* const> tables, int threads, Image& albedo)
{
    if (tables.size() == 1) {
        refitAlbedo(block, normals, lights, *tables[0], threads, albedo);
        return;
    }
    forEachMaterial(
        block, {}, {}, tables.size(), [&](uint32_t pixel) -> size_t { return labels[pixel]; },
        [&](size_t material, const BlockPart& part) {
            refitAlbedo(part.seen, normals, lights, *tables[material], threads, albedo);
        });
}

std::vector<glm::vec3> finishAlbedo(const Capture& capture, std::span<const uint8_t> labels,
                                    std::span<BrdfTable* const> tables, Image& albedo)
{
    if (tables.size() == 1) {
        return {finishOne(capture, capture.mask, *tables[0], albedo)};
    }
    std::vector<glm::vec3> scales;
    for (size_t m = 0; m < tables.size(); ++m) {
        std::vector<uint8_t> object(labels.size());
        std::transform(labels.begin(), labels.end(), object.begin(), [&](uint8_t label) { return label == m; });
        Image own = keptWhere(albedo, object);
        scales.push_back(finishOne(capture, object, *tables[m], own));
        for (size_t i = 0; i < object.size(); ++i) {
            if (object[i]) {
                std::copy_n(&own.values[3 * i], 3, &albedo.values[3 * i]);
            }
        }
    }
    return scales;
}

} // namespace nacre
