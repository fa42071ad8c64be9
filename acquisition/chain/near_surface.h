#pragma once
#include "acquisition/chain/acquire_options.h"
#include "acquisition/chain/normal_estimation.h"

namespace nacre {

// Judges the sample of the photographs in use.
void checkSample(const AcquireOptions& options, PreparedCapture& prepared);

// Where lights are near or the camera has a lens, finds the surface that they stand before: normals from the
// photographs as if the lights were distant (as_if_distant.h), a height from the normals, and again with both known.
// With options.estimateDistance, where the capture says nothing of distances and its self-check suspects near lights,
// one distance of all lights is estimated; it is taken where the normals so found predict held-out lights better.
// `seen`: the sample as photographed, under the lights in use.
void approachSurface(const Capture& capture, const Observations& seen, const AcquireOptions& options, StageClock& clock,
                     const Progress& progress, PreparedCapture& prepared);

} // namespace nacre
