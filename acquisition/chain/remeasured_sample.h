#pragma once
#include <span>
#include <vector>

#include "acquisition/brdf/interpolation_choice.h"
#include "acquisition/chain/normal_estimation.h"
#include "engine/surface/surface.h"

namespace nacre {

// How a capture was measured, for measuring some of its pixels again. Refers to what it is made of.
struct Measurement {
    const PreparedCapture& prepared;
    const ChosenMethod& method;
    const Segmentation& segmentation;
    const AcquireOptions& options;
    const std::vector<InterpolationChoice>& interpolations; // one a material
    const Surface& surface;                                 // what came of it
};

// A picture of one row, the sample's pixels, as they are measured from the sample alone and without the lights named:
// normals by the method that was chosen, BRDFs on coarse tables, albedo factors. Its lights are all of the capture's.
// Materials that the sample has nothing of are empty, and no pixel is of them.
Surface remeasured(const Measurement& measurement, Observations sample, std::span<const size_t> without);

} // namespace nacre
