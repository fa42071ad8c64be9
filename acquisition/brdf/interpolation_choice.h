#pragma once
#include "acquisition/brdf/interpolation.h"

namespace nacre {

struct InterpolationChoice {
    InterpolationOptions options;
    double error = 0; // root mean square on the held-out samples, of the values' 99th percentile; beyond it clipped
    double firstError = 0; // of the options that the choice began with
    size_t heldOut = 0;    // samples that judged; 0 where there were too few to hold any out
};

// The k and the metric that predict best what was held out: samples of every sixth plane of thetaD (of one photograph
// each), neither the first nor the last, or every sixth sample where there are few planes. One axis after the other,
// from `start` on, so the choice is a good one, not the best of all. The paper's way has only k.
InterpolationChoice chooseInterpolation(const BrdfSamples& samples, const InterpolationOptions& start);

} // namespace nacre
