#pragma once
#include "acquisition/brdf/interpolation.h"

namespace nacre {

struct InterpolationChoice {
    InterpolationOptions options;
    double error = 0;      // errorOf held_out_planes.h
    double firstError = 0; // of the options that the choice began with
    size_t heldOut = 0;    // samples that judged; 0 where there were too few to hold any out
};

// The k and the metric that predict best what is held out (held_out_planes.h). One axis after the other, from `start`
// on, so the choice is a good one, not the best of all. The paper's way has only k.
InterpolationChoice chooseInterpolation(const BrdfSamples& samples, const InterpolationOptions& start);

} // namespace nacre
