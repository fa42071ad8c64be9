#include "acquisition/chain/material_albedo.h"

#include <algorithm>
#include <optional>

#include "acquisition/brdf/slope_trend.h"
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

glm::vec3 finishOne(const Capture& capture, const std::vector<uint8_t>& object, bool haveOneAlbedo, BrdfTable& table,
                    Image& albedo)
{
    if (!capture.smooth.empty()) {
        fillSmoothly(albedo, capture.smooth, object);
    }
    return normaliseAlbedo(haveOneAlbedo, albedo, table);
}

} // namespace

std::vector<uint8_t> takeSlopeTrends(const NormalMap& normals, const LocalLights& lights,
                                     std::span<const uint8_t> labels, std::span<const uint8_t> haveOneAlbedo,
                                     Image& albedo)
{
    std::vector<uint8_t> taken(haveOneAlbedo.size());
    for (size_t m = 0; m < haveOneAlbedo.size(); ++m) {
        if (!haveOneAlbedo[m]) {
            continue;
        }
        std::vector<uint32_t> pixels;
        std::vector<glm::vec3> factors;
        std::vector<float> cosines;
        for (uint32_t i = 0; i < labels.size(); ++i) {
            if (labels[i] == m && normals.confidence[i] > 0) {
                pixels.push_back(i);
                factors.emplace_back(albedo.values[3 * i], albedo.values[3 * i + 1], albedo.values[3 * i + 2]);
                cosines.push_back(lights.toLocal(i, normals.normals[i]).z);
            }
        }
        const std::optional<SlopeTrend> trend = SlopeTrend::of(factors, cosines);
        taken[m] = trend.has_value();
        for (size_t k = 0; k < pixels.size() && trend; ++k) {
            const glm::vec3 factor = factors[k] / trend->at(cosines[k]);
            std::copy_n(&factor.x, 3, &albedo.values[3 * size_t{pixels[k]}]);
        }
    }
    return taken;
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
