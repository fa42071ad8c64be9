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

void MaterialSamples::gather(const Observations& block, const NormalBlock& normals, const std::vector<Light>& lights,
                             Image& albedo)
{
    const std::vector<glm::vec3> factors = albedoFactors(block, normals, lights);
    storeAlbedo(block, factors, albedo);
    const auto label = [&](uint32_t pixel) -> size_t {
        return segmentation_.inner[pixel] ? segmentation_.labels[pixel] : kUnlabelled;
    };
    const auto take = [&](size_t material, const BlockPart& part) {
        const double observations =
            static_cast<double>(segmentation_.regions[material].inner) * static_cast<double>(lights.size());
        const double share = static_cast<double>(options_.samples.most) / std::max(observations, 1.0);
        samples[material].domain = tableDomain(lights, options_.bake);
        gatherSamples(part.seen, part.normals, part.albedo, lights, share, options_.samples, samples[material],
                      counts_);
    };
    forEachMaterial(block, normals, factors, samples.size(), label, take);
}

} // namespace nacre
