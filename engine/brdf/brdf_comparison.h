#pragma once
#include <functional>
#include <vector>

#include "engine/brdf/brdf_models.h"
#include "shared/coverage.h"

namespace nacre {

// f(l, v) with its coverage, l and v unit in the tangent frame.
using BrdfFunction = std::function<BrdfValue(const glm::vec3& l, const glm::vec3& v)>;

BrdfFunction functionOf(const BrdfModel& model);

// Configurations at which BRDFs are compared and audited: evenly over (sqrt(thetaH), thetaD, phiD), phiD over the
// whole turn, light and view at most 87 degrees from the normal: beyond, BRDFs divide by cosines near 0. The same ones
// every time (Halton's sequence). At most `count`.
std::vector<LightView> comparisonConfigurations(size_t count);

struct BrdfComparison {
    double psnr = 0;           // dB; values divided by the reference's 99th percentile and clipped to [0,1]
    double median = 0;         // of |f - reference| / max(reference, 1 % of the peak)
    double percentile95 = 0;   // of the same, channels pooled
    double peak = 0;           // largest value of the reference among the configurations
    size_t configurations = 0; // compared: both cover them
    size_t outOf = 0;          // tried
};

// At comparisonConfigurations, where both are covered.
BrdfComparison compareBrdfs(const BrdfFunction& f, const BrdfFunction& reference, size_t count = 200000);

// The same from values side by side; outOf is left 0. Not both may be empty.
BrdfComparison compareValues(const std::vector<glm::vec3>& values, const std::vector<glm::vec3>& reference);

} // namespace nacre
