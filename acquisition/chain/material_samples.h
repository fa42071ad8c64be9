#pragma once
#include <span>
#include <vector>

#include "acquisition/chain/acquire_options.h"
#include "acquisition/segmentation/segmentation.h"

namespace nacre {

// What is sampled on the way over a capture's blocks.
struct MaterialSamples {
    std::vector<BrdfSamples> samples; // of f, one set a material, from its inner pixels
    SampleCounts counts;              // of all of them
    Image albedo;                     // a first factor of every pixel, over whole photographs
};

MaterialSamples startSamples(const Capture& capture, const LocalLights& lights, const Segmentation& segmentation,
                             const BakeOptions& options);

// Adds a block's samples and factors.
void gatherSamples(const Observations& block, const NormalBlock& normals, const LocalLights& lights,
                   const Segmentation& segmentation, const AcquireOptions& options, MaterialSamples& gathered);

// The same by what tables of the samples so far, one a material, say of each observation (gatherJudgedSamples of
// brdf_samples.h). The block's factors are refitted to them first, but of materials whose pixels share an albedo.
void gatherJudgedSamples(const Observations& block, const NormalMap& normals, const LocalLights& lights,
                         const Segmentation& segmentation, std::span<BrdfTable* const> tables,
                         std::span<const uint8_t> haveOneAlbedo, const AcquireOptions& options,
                         MaterialSamples& gathered);

} // namespace nacre
