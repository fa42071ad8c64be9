#include "acquisition/residual/light_interpolation.h"

#include <Eigen/Dense>

#include "engine/lights/light_covariance.h"

namespace nacre {

namespace {

// Of an observation, on the kernel's scale. Equal lights are averaged.
constexpr double kNoiseVariance = 1e-3;

} // namespace

Eigen::MatrixXd interpolationFactors(std::span<const glm::vec3> nodes)
{
    const auto n = static_cast<Eigen::Index>(nodes.size());
    Eigen::MatrixXd covariance(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < n; ++j) {
            covariance(i, j) = lightCovariance(nodes[i], nodes[j]) + (i == j ? kNoiseVariance : 0.0);
        }
    }
    return covariance.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
}

Eigen::MatrixXd leaveOneOutWeights(std::span<const glm::vec3> nodes)
{
    const Eigen::MatrixXd inverse = interpolationFactors(nodes);
    Eigen::MatrixXd weights = -(inverse.diagonal().cwiseInverse().asDiagonal() * inverse);
    weights.diagonal().setZero();
    return weights;
}

} // namespace nacre
