#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "acquisition/segmentation/pixel_traits.h"

namespace nacre {

struct ValleyOptions {
    float bandwidth = 0;  // standard deviation of the Gaussian kernel, in the values' unit
    float leastGap = 0;   // between the two peaks
    double deepest = 0.5; // a valley is lower than this share of the lower peak
    size_t fewest = 1;    // values on either side
};

// Where values fall into two groups.
struct Valley {
    float threshold = 0;
    double depth = 1; // density there over that of the lower peak
    float gap = 0;    // between the peaks
};

// The lowest valley of the values' density (a kernel estimate on a grid of a quarter of the bandwidth) that fulfils the
// options and is no chance: the lower peak's count, within a bandwidth, exceeds the valley's by four standard
// deviations of Poisson's law. None where there is no such valley. Values have to be finite.
std::optional<Valley> deepestValley(const std::vector<float>& values, const ValleyOptions& options);

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
