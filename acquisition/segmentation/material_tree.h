#pragma once
#include <cstdint>
#include <vector>

#include "acquisition/segmentation/pixel_traits.h"

namespace nacre {

struct FoundMaterials {
    std::vector<uint8_t> labels; // of each pixel's traits, 255 where they do not tell
    size_t count = 1;
};

// Groups of pixels of one material. Groups are halved, one after the other, where the density of a trait has a valley
// that is clear against the pixels' own scatter: chromaticity first (of eight directions in its plane the one with the
// deepest), then albedo, where it is clearly in two groups a factor of 1.6 or more apart and with next to nothing
// between, then the lobe, as a share of what the group's glossier pixels show at the same thetaH. A texture whose
// colour or albedo runs evenly is one material. `count` > 0: the clearest so many groups, and where valleys do not
// suffice halves about the mean of what scatters most. Materials are numbered by size, the largest first.
FoundMaterials findMaterials(const std::vector<PixelTraits>& traits, size_t count);

} // namespace nacre
