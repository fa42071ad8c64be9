#pragma once
#include <cstddef>
#include <optional>
#include <vector>

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

} // namespace nacre
