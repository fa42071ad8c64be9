#pragma once
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

} // namespace nacre
