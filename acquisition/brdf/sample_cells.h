#pragma once
#include "acquisition/brdf/brdf_samples.h"

namespace nacre {

// Samples that lie so close together that no model tells them apart, taken as one: a photograph of a curved object
// repeats the same configuration in many pixels. Averages the noise away and leaves an index a fraction of its size.
// The value is a robust mean, so that interreflections and wrong normals move it little (Huber, Robust Estimation of a
// Location Parameter, 1964); the weight is the square root of the summed squares: two samples alike weigh like one of
// half the variance. samples: usable ones.
BrdfSamples condensedSamples(const BrdfSamples& samples, int threads);

} // namespace nacre
