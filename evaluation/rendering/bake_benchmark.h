#pragma once
#include <cstddef>

namespace nacre {

// Seconds by the wall clock, in one run.
struct BakeBenchmark {
    size_t samples = 0;
    size_t texels = 0;
    int k = 0;
    double bareQueries = 0; // k nearest of all samples for each texel by nanoflann alone, its index included
    double bake = 0;        // bakeBrdf from the same samples to the same texels
};

// A table of 90 x 90 x 180 texels from a million samples on the planes of 96 lights.
BakeBenchmark benchmarkBake(int threads);

} // namespace nacre
