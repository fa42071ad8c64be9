#include "acquisition/chain/material_albedo.h"

#include <algorithm>

#include "acquisition/chain/material_blocks.h"
#include "acquisition/normals/smooth_fill.h"
#include "engine/files/measures.h"

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

glm::vec3 finishOne(const Capture& capture, const std::vector<uint8_t>& object, bool haveOneAlbedo, BrdfTable& table,
                    Image& albedo)
{
    if (!capture.smooth.empty()) {
        fillSmoothly(albedo, capture.smooth, object);
    }
    return normaliseAlbedo(haveOneAlbedo, albedo, table);
}

} // namespace

void shareAlbedos(const NormalMap& normals, std::span<const uint8_t> labels, std::span<const uint8_t> haveOneAlbedo,
                  Image& albedo)
{
    for (size_t m = 0; m < haveOneAlbedo.size(); ++m) {
        std::vector<size_t> pixels;
        for (size_t i = 0; i < labels.size() && haveOneAlbedo[m]; ++i) {
            const float* factor = &albedo.values[3 * i];
            if (labels[i] == m && normals.confidence[i] > 0 && factor[0] + factor[1] + factor[2] > 0) {
                pixels.push_back(i);
            }
        }
        for (size_t c = 0; c < 3 && !pixels.empty(); ++c) {
            std::vector<float> factors;
            for (const size_t i : pixels) {
                factors.push_back(albedo.values[3 * i + c]);
            }
            const float median = quantile(factors, 0.5);
            for (const size_t i : pixels) {
                albedo.values[3 * i + c] = median;
            }
        }
    }
}

void refitAlbedo(const Observations& block, const NormalMap& normals, const LocalLights& lights,
                 std::span<const uint8_t> labels, std::span<BrdfTable* const> tables, int threads, Image& albedo)
{
    if (tables.size() == 1) {
        if (tables[0]) {
            refitAlbedo(block, normals, lights, *tables[0], threads, albedo);
        }
        return;
    }
    forEachMaterial(
        block, {}, {}, tables.size(), [&](uint32_t pixel) -> size_t { return labels[pixel]; },
        [&](size_t material, const BlockPart& part) {
            if (tables[material]) {
                refitAlbedo(part.seen, normals, lights, *tables[material], threads, albedo);
            }
        });
}

std::vector<glm::vec3> finishAlbedo(const Capture& capture, std::span<const uint8_t> labels,
                                    std::span<const uint8_t> haveOneAlbedo, std::span<BrdfTable* const> tables,
                                    Image& albedo)
{
    if (tables.size() == 1) {
        return {finishOne(capture, capture.mask, haveOneAlbedo[0], *tables[0], albedo)};
    }
    std::vector<glm::vec3> scales;
    for (size_t m = 0; m < tables.size(); ++m) {
        std::vector<uint8_t> object(labels.size());
        std::transform(labels.begin(), labels.end(), object.begin(), [&](uint8_t label) { return label == m; });
        Image own = keptWhere(albedo, object);
        scales.push_back(finishOne(capture, object, haveOneAlbedo[m], *tables[m], own));
        for (size_t i = 0; i < object.size(); ++i) {
            if (object[i]) {
                std::copy_n(&own.values[3 * i], 3, &albedo.values[3 * i]);
            }
        }
    }
    return scales;
}

} // namespace nacre
