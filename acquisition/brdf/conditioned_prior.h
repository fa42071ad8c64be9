#pragma once
#include "acquisition/brdf/brdf_samples.h"
#include "acquisition/brdf/material_prior.h"

namespace nacre {

// The prior of one material, given its samples.
struct ConditionedPrior {
    std::vector<glm::vec3> logValues; // per node: the mean of log f
    std::vector<float> variances;     // per node: of log f
    float misfit = 0;                 // root mean square of log f that the mean leaves of the samples

    // f at unit coordinates of `domain`.
    glm::vec3 evaluate(const TableDomain& domain, const glm::vec3& unit) const;
    float variance(const TableDomain& domain, const glm::vec3& unit) const;
};

// Regularised least squares: with the samples as rows, y = log f - mean, A = components and W the inverse variances of
// their errors, c = (A' W A + 1)^-1 A' W y, and its covariance is (A' W A + 1)^-1. Samples are averaged about each node
// first. A sample's error has three parts: what no component tells, noise of the photographs over the radiance, and an
// error of the normal, d theta tan theta of the direction nearer to the horizon, since f = I / (E n.l). The first is
// what a fit of 2 % misses of the samples, if that is more. samples: usable ones in half-difference coordinates, one at
// least.
ConditionedPrior conditionedPrior(const MaterialPrior& prior, const BrdfSamples& samples);

} // namespace nacre
