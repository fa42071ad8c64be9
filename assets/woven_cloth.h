#pragma once
#include "engine/scene/normal_map.h"

namespace nacre {

// A plain weave seen from the front: over and under in turn, twisted yarns of elliptical section, a little drape.
struct WovenClothOptions {
    int yarns = 24;            // across the picture's shorter side, in either direction
    double cover = 0.86;       // a yarn's width, of the spacing
    double flatness = 0.72;    // height of a yarn's section over its width
    double crimp = 0.55;       // rise and fall of a yarn's middle, of the section's height
    double fibreDepth = 0.022; // of the twist's grooves, of the yarn's width
    double wander = 0.08;      // how far yarns stray and swell, of their width
    double drapeSlope = 0.55;  // of the folds, rise over run
    int threads = 0;           // 0 = all
};

NormalMap wovenCloth(int width, int height, const WovenClothOptions& options = {});

} // namespace nacre
