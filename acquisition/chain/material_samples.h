#pragma once
#include <vector>

#include "acquisition/chain/acquire_options.h"
#include "acquisition/segmentation/segmentation.h"

namespace nacre {

// Samples of f of each material from its inner pixels, with a first albedo factor of every pixel.
class MaterialSamples {
public:
    MaterialSamples(const Segmentation& segmentation, const AcquireOptions& options, SampleCounts& counts)
        : samples(segmentation.regions.size()), segmentation_(segmentation), options_(options), counts_(counts)
    {
    }

    // `albedo`: the factors, over whole photographs.
    void gather(const Observations& block, const NormalBlock& normals, const std::vector<Light>& lights, Image& albedo);

    std::vector<BrdfSamples> samples; // one a material

private:
    const Segmentation& segmentation_;
    const AcquireOptions& options_;
    SampleCounts& counts_;
};

} // namespace nacre
