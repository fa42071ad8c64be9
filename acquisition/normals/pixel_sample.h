#pragma once
#include "acquisition/capture/capture.h"
#include "acquisition/capture/observations.h"

namespace nacre {

// A few thousand pixels spread evenly over what was seen of all of the mask; all of them where they are no more.
Observations evenSample(const Observations& whole);

// A few thousand pixels spread evenly over the whole mask, for methods that look at the object before its pixels.
// `first` is the capture's first block; a capture of more blocks is read once for the sample.
Observations samplePixels(const Capture& capture, const Observations& first, int threads, size_t byteBudget);

} // namespace nacre
