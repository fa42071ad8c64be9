#pragma once
#include <memory>

#include "acquisition/brdf/interpolation.h"

namespace nacre {

// Interpolates scattered samples as the paper does: the k nearest neighbours in raw angles (radians), averaged with the
// Epanechnikov kernel 3/4 (1 - u^2), u = distance / bandwidth (Wu et al., Eq. 10; Simonoff, Smoothing Methods in
// Statistics, 1996). The bandwidth is the distance of the (k+1)-th neighbour, so that the k-th still weighs, and never
// less than kBandwidthFloor, so that coincident samples are averaged. With fewer than k + 1 samples, all are used.
class KernelRegression {
public:
    static constexpr float kBandwidthFloor = 1e-6f; // radians

    // Throws Error where there is no sample.
    KernelRegression(const BrdfSamples& samples, int k);
    ~KernelRegression();
    InterpolatedValue evaluate(const glm::vec3& unit) const;

private:
    struct Index;
    std::unique_ptr<Index> index_;
};

} // namespace nacre
