#pragma once
#include "acquisition/capture/observations.h"

namespace nacre {

// Every so many pixels are taken for a sample of a few thousand out of `pixels`.
size_t sampleStep(size_t pixels);

// Adds the block's pixels whose number, counted from that of its first, is a multiple of `step`.
void addToSample(const Observations& block, size_t firstNumber, size_t step, Observations& sample);

// A few thousand pixels spread evenly over what was seen; all of them where they are no more.
Observations evenSample(const Observations& whole);

} // namespace nacre
