#include "acquisition/chain/material_samples.h"

#include <algorithm>
#include <functional>

#include "acquisition/brdf/albedo_factor.h"
#include "acquisition/chain/material_albedo.h"
#include "acquisition/chain/material_blocks.h"

namespace nacre {

namespace {

void storeAlbedo(const Observations& block, const std::vector<glm::vec3>& factors, Image& albedo)
{
    for (size_t p = 0; p < factors.size(); ++p) {
        const uint32_t pixel = block.pixels[p];
        albedo.setRgb(static_cast<int>(pixel % albedo.width), static_cast<int>(pixel / albedo.width), factors[p]);
    }
}

// Of all pixels, so that a material has no more samples than are asked for.
double sampledShare(const MaterialRegion& region, size_t lights, const SampleOptions& options)
{
    const double observations = static_cast<double>(region.inner) * static_cast<double>(lights);
    return static_cast<double>(options.most) / std::max(observations, 1.0);
}

std::function<size_t(uint32_t)> innerLabels(const Segmentation& segmentation)
{
    return
        [&](uint32_t pixel) -> size_t { return segmentation.inner[pixel] ? segmentation.labels[pixel] : kUnlabelled; };
}

} // namespace

MaterialSamples startSamples(const Capture& capture, const LocalLights& lights, const Segmentation& segmentation,
                             const BakeOptions& options)
{
    BrdfSamples none;
    none.domain = tableDomain(lights.over(capture), options.range, options.coordinates.value_or(kOneWay));
    return {std::vector<BrdfSamples>(segmentation.regions.size(), none), {}, Image(capture.width, capture.height, 3)};
}

void gatherSamples(const Observations& block, const NormalBlock& normals, const LocalLights& lights,
                   const Segmentation& segmentation, const AcquireOptions& options, MaterialSamples& gathered)
{
    const std::vector<glm::vec3> factors = albedoFactors(block, normals, lights.reference());
    storeAlbedo(block, factors, gathered.albedo);
    const auto take = [&](size_t material, const BlockPart& part) {
        const double share = sampledShare(segmentation.regions[material], block.lightCount, options.samples);
        BrdfSamples& samples = gathered.samples[material];
        gatherSamples(part.seen, part.normals, part.albedo, lights, share, options.samples, samples, gathered.counts);
    };
    forEachMaterial(block, normals, factors, gathered.samples.size(), innerLabels(segmentation), take);
}

void gatherJudgedSamples(const Observations& block, const NormalMap& normals, const LocalLights& lights,
                         const Segmentation& segmentation, std::span<BrdfTable* const> tables,
                         std::span<const uint8_t> haveOneAlbedo, const AcquireOptions& options,
                         MaterialSamples& gathered)
{
    std::vector<BrdfTable*> fitted(tables.begin(), tables.end());
    for (size_t m = 0; m < fitted.size(); ++m) {
        fitted[m] = haveOneAlbedo[m] ? nullptr : fitted[m];
    }
    refitAlbedo(block, normals, lights, segmentation.labels, fitted, options.samples.threads, gathered.albedo);
    const auto take = [&](size_t material, const BlockPart& part) {
        const double share = sampledShare(segmentation.regions[material], block.lightCount, options.samples);
        gatherJudgedSamples(part.seen, normals, gathered.albedo, lights, *tables[material], share, options.samples,
                            gathered.samples[material]);
    };
    forEachMaterial(block, {}, {}, gathered.samples.size(), innerLabels(segmentation), take);
}

} // namespace nacre
