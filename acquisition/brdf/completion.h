#pragma once
#include "acquisition/brdf/conditioned_prior.h"
#include "acquisition/brdf/interpolation.h"

namespace nacre {

// The whole BRDF from the part that was seen. With p the prior's mean given the samples and r the samples' ratios to
// it, interpolated by local_linear.h,
//   f = p r                                  where samples are near,
//   f = p r^w,  w = exp(-(d / kFade)^2 / 2)   at the distance d from the nearest one,
// so that what was measured stands, and what the prior misses of it fades without a seam. Beyond the largest thetaD
// that was measured this is mixed, in logarithms, with f at that thetaD by the trust that the samples themselves show
// in the prior: see trustInPrior. Never negative; symmetric as the coordinates are.
// Its expected relative error adds squares: of the prior's deviation and misfit, as the ratio fades; of the move beyond
// the measured thetaD; of the distance; of the misfit everywhere; of normals, d theta tan theta of the direction nearer
// to the horizon. The weights are chosen on ABC fits.
class CompletedBrdf {
public:
    static constexpr float kFade = 0.35f; // radians

    // Of f at unit coordinates: at the largest measured thetaD if they are beyond it, and as the prior has it.
    struct Extrapolation {
        glm::vec3 border, prior;
        float nearest; // radians
    };

    // samples: usable and condensed ones in half-difference coordinates, one at least.
    CompletedBrdf(const BrdfSamples& samples, const InterpolationOptions& options, const MaterialPrior& prior);
    InterpolatedValue evaluate(const glm::vec3& unit) const;

private:
    TableDomain domain_;
    ConditionedPrior prior_;
    BrdfInterpolant ratio_;
    float reach_; // largest thetaD of the samples, in unit coordinates
    glm::ivec2 borderSize_;
    std::vector<InterpolatedValue> borderRatios_; // at reach_, over (thetaH, phiD) as full tables have them
    float trust_ = 1;

    InterpolatedValue ratioAtBorder(const glm::vec3& unit) const;
    float expectedError(const glm::vec3& unit, const Extrapolation& e, const glm::vec3& value) const;
};

// The share of the prior, in [0, 1], by which samples beyond 0.7 of the largest thetaD are predicted best from those
// below it: least squares in log f over the radiance that they show, against f at the border. 1 where there are none to
// tell.
float trustInPrior(const BrdfSamples& samples, const InterpolationOptions& options, const MaterialPrior& prior);

} // namespace nacre
