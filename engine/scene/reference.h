#pragma once
#include "engine/scene/scene.h"

namespace nacre {

// The CPU twin of shaders/direct.frag: the same shared formulas, per pixel and light one lookup of the table.
Frame renderReference(const Scene& scene, int threads = 0);

} // namespace nacre
