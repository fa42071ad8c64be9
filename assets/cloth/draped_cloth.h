#pragma once
#include <string>
#include <vector>

#include "assets/synth/target.h"

namespace nacre {

// A large sheet that has fallen: hung from two points, or laid over a ball and seen a little from above.
struct DrapedClothOptions {
    std::string way = "hung"; // drapeNames()
    double stiffness = 0.1;   // 0 = limp, narrow folds; 1 = stiff, broad ones
    uint64_t seed = 1;        // of the disturbance that folds begin from
};

std::vector<std::string> drapeNames();

// Parts: face, reverse (where the sheet turns its other side to the viewer).
Target drapedCloth(int width, int height, const DrapedClothOptions& options = {}, int threads = 0);

} // namespace nacre
