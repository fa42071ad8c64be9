#pragma once
#include "engine/scene/normal_map.h"

namespace nacre {

// A carved bust in the antique manner, from a signed distance field, seen by a distant camera.
struct StatueHeadOptions {
    double turnDegrees = 24; // of the head about the vertical, towards the picture's right
    double bowDegrees = 5;   // forward
    int threads = 0;         // 0 = all
};

// Beside the bust the map has no data.
NormalMap statueHead(int width, int height, const StatueHeadOptions& options = {});

} // namespace nacre
