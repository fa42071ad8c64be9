#pragma once
#include "assets/synth/target.h"

namespace nacre {

// Stockinette seen from its face: rows (courses) of loops, each drawn through the loop below it from behind.
struct KnitOptions {
    int loops = 18;      // across the picture's shorter side
    double curl = 0.5;   // tangent of the yarn's twist angle
    double drape = 0.25; // slope of the long folds, rise over run
    double wander = 1;   // irregularity of the loops; 0 = a machine's drawing
    int stripes = 4;     // courses of one yarn before the other takes over
    uint64_t seed = 1;
};

// Parts: the two yarns of the stripes.
Target knit(int width, int height, const KnitOptions& options = {}, int threads = 0);

} // namespace nacre
