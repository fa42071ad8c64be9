#pragma once
#include "assets/synth/target.h"

namespace nacre {

// A carved bust in the antique manner, from a signed distance field, seen by a distant camera.
struct StatueHeadOptions {
    double turnDegrees = 24; // of the head about the vertical, towards the picture's right
    double bowDegrees = 5;   // forward
};

// Parts: skin, hair, cloak. Beside the bust there is no data.
Target statueHead(int width, int height, const StatueHeadOptions& options = {}, int threads = 0);

} // namespace nacre
