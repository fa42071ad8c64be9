#pragma once
#include <string>

#include "assets/synth/target.h"

namespace nacre {

// A weave seen from the front. Lengths are in yarn spacings where nothing else is said.
struct WovenClothOptions {
    std::string weave = "plain"; // weaveNames()
    int threads = 32;            // yarns across the picture's shorter side, in either direction
    double curl = 0.5;           // tangent of the yarns' twist angle, 0 = fibres lie straight
    double drape = 0.35;         // slope of the long folds, rise over run; 0 = flat
    double wander = 1;           // irregularity of yarns: how far they stray and swell; 0 = a machine's drawing
    uint64_t seed = 1;
};

// Parts: warp (upright), weft.
Target wovenCloth(int width, int height, const WovenClothOptions& options = {}, int threads = 0);

} // namespace nacre
