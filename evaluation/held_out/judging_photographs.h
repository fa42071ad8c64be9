#pragma once
#include <vector>

#include "acquisition/chain/acquire.h"

namespace nacre {

// Photographs that an acquisition is not given, and what predictions of them are measured against.
struct JudgingPhotographs {
    Observations seen;
    std::vector<Light> lights;
    double peak = 1; // radiance that counts as 1
};

// Indices of the photographs that a choice holds out.
std::vector<size_t> heldOutIndices(size_t photographs, const LightChoice& choice);

// Reads these photographs alone, at once. The peak is of their own values.
JudgingPhotographs readJudging(const Capture& capture, const AcquireOptions& options, size_t every);

// dB of radiance of all of them together.
double psnrOf(const Surface& surface, const JudgingPhotographs& judging, int threads);

} // namespace nacre
