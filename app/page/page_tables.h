#pragma once
#include <string>

#include "engine/surface/surface.h"

namespace nacre {

struct PageTable {
    Material material;       // as heldByPage has it
    std::string description; // of the table that was taken, and what it costs in dB
};

// The smallest of the ladder's tables whose radiance is within `toleranceDecibels` of the material's own; the
// material's own table where none is. Throws Error (data) where a page cannot hold it.
PageTable tableForPage(Material material, double toleranceDecibels, int threads);

} // namespace nacre
