#include "acquisition/chain/material_samples.h"

#include <algorithm>

#include "acquisition/brdf/albedo_factor.h"
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

} // namespace

MaterialSamples startSamples(const Capture& capture, const LocalLights& lights, const Segmentation& segmentation,
                             const BakeOptions& options)
{
    BrdfSamples none;
    none.domain = tableDomain(lights.over(capture), options);
    return {std::vector<BrdfSamples>(segmentation.regions.size(), none), {}, Image(capture.width, capture.height, 3)};
}

void gatherSamples(const Observations& block, const NormalBlock& normals, const LocalLights& lights,
                   const Segmentation& segmentation, const AcquireOptions& options, MaterialSamples& gathered)
{
    const std::vector<glm::vec3> factors = albedoFactors(block, normals, lights.reference());
    storeAlbedo(block, factors, gathered.albedo);
    const auto label = [&](uint32_t pixel) -> size_t {
        return segmentation.inner[pixel] ? segmentation.labels[pixel] : kUnlabelled;
    };
    const auto take = [&](size_t material, const BlockPart& part) {
        const double observations =
            static_cast<double>(segmentation.regions[material].inner) * static_cast<double>(block.lightCount);
        const double share = static_cast<double>(options.samples.most) / std::max(observations, 1.0);
        BrdfSamples& samples = gathered.samples[material];
        gatherSamples(part.seen, part.normals, part.albedo, lights, share, options.samples, samples, gathered.counts);
    };
    forEachMaterial(block, normals, factors, gathered.samples.size(), label, take);
}

} // namespace nacre
