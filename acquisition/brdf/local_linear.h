#pragma once
#include <memory>

#include "acquisition/brdf/interpolation.h"

namespace nacre {

// Interpolates scattered samples by a plane fitted to the k nearest in the embedded metric with the Epanechnikov kernel
// (Cleveland, Robust Locally Weighted Regression, 1979; Fan and Gijbels, Local Polynomial Modelling, 1996): no bias
// at the border of what was measured and none across a slope, where a mean has both. The plane is fitted to the cube
// roots, which are nearer to linear beside a highlight than the values are. Slopes that the neighbours do not determine
// (all on one plane of thetaD, one sample) are 0. The value is never negative and never further beyond the neighbours'
// own range than kOvershoot of it. The bandwidth is the distance of the (k+1)-th neighbour, 1.1 times the furthest
// where there are fewer, and never below kBandwidthFloor.
class LocalLinearRegression {
public:
    static constexpr float kOvershoot = 0.25f;
    static constexpr float kBandwidthFloor = 1e-6f; // of the embedded space

    // samples: usable ones, one at least.
    LocalLinearRegression(const BrdfSamples& samples, const SampleMetric& metric, int k);
    ~LocalLinearRegression();
    InterpolatedValue evaluate(const glm::vec3& unit) const;

private:
    struct Index;
    std::unique_ptr<Index> index_;
};

} // namespace nacre
