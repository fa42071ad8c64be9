#include "acquisition/chain/material_normals.h"

#include <algorithm>

#include <fmt/format.h>

#include "acquisition/chain/material_blocks.h"
#include "acquisition/chain/prepared_normals.h"
#include "acquisition/exemplar/normal_method.h"

namespace nacre {

namespace {

constexpr size_t kFewestInSample = 50;

NormalEstimator estimatorOf(const MaterialRegion& region, const Observations& sample, const std::vector<Light>& lights,
                            const NormalOptions& options, bool isLargest, NormalReport& report)
{
    NormalReport own;
    NormalEstimator estimator = makeNormalEstimator(intensitiesOf(sample, lights), lights, options, own);
    for (const std::string& remark : own.remarks) {
        report.remarks.push_back(fmt::format("{}: {}", region.name, remark));
    }
    if (isLargest) {
        report.method = own.method;
    }
    return estimator;
}

} // namespace

std::vector<NormalEstimator> estimatorsByMaterial(const Observations& sample, const Segmentation& materials,
                                                  const std::vector<Light>& lights, const NormalOptions& options,
                                                  NormalReport& report)
{
    const size_t count = materials.regions.size();
    if (count == 1) {
        return {makeNormalEstimator(intensitiesOf(sample, lights), lights, options, report)};
    }
    std::vector<Observations> samples(count);
    forEachMaterial(
        sample, {}, {}, count,
        [&](uint32_t pixel) -> size_t { return materials.inner[pixel] ? materials.labels[pixel] : kUnlabelled; },
        [&](size_t material, const BlockPart& part) { samples[material] = part.seen; });
    const auto largest = std::max_element(materials.regions.begin(), materials.regions.end(),
                                          [](const auto& a, const auto& b) { return a.pixels < b.pixels; });
    std::vector<NormalEstimator> estimators;
    for (size_t m = 0; m < count; ++m) {
        const bool enough = samples[m].pixels.size() >= kFewestInSample;
        const MaterialRegion& region = materials.regions[m];
        estimators.push_back(
            estimatorOf(region, enough ? samples[m] : sample, lights, options, &region == &*largest, report));
    }
    return estimators;
}

NormalBlock estimateByMaterial(const std::vector<NormalEstimator>& estimators, const Segmentation& materials,
                               const Observations& block, const std::vector<Light>& lights)
{
    NormalBlock all{std::vector<PixelNormal>(block.pixels.size()), std::vector<Verdict>(block.saturated.size())};
    forEachMaterial(
        block, {}, {}, estimators.size(), [&](uint32_t pixel) -> size_t { return materials.labels[pixel]; },
        [&](size_t material, const BlockPart& part) {
            const NormalBlock own = estimateBlock(estimators[material], part.seen, lights);
            for (size_t p = 0; p < part.places.size(); ++p) {
                all.pixels[part.places[p]] = own.pixels[p];
                std::copy_n(own.verdicts.begin() + static_cast<std::ptrdiff_t>(p * lights.size()), lights.size(),
                            all.verdicts.begin() + static_cast<std::ptrdiff_t>(part.places[p] * lights.size()));
            }
        });
    return all;
}

} // namespace nacre
