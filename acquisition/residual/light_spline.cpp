#include "acquisition/residual/light_spline.h"

#include <Eigen/Dense>

#include "engine/surface/residual_layer.h"

namespace nacre {

Eigen::RowVectorXd splineTerms(std::span<const glm::vec2> nodes, const glm::vec2& point)
{
    const auto n = static_cast<Eigen::Index>(nodes.size());
    Eigen::RowVectorXd terms(n + 3);
    for (Eigen::Index i = 0; i < n; ++i) {
        terms(i) = thinPlateKernel(point, nodes[i]);
    }
    terms.tail<3>() << 1, point.x, point.y;
    return terms;
}

namespace {

Eigen::MatrixXd splineSystem(std::span<const glm::vec2> nodes, double penalty)
{
    const auto n = static_cast<Eigen::Index>(nodes.size());
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 3, n + 3);
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < n; ++j) {
            system(i, j) = thinPlateKernel(nodes[i], nodes[j]) + (i == j ? penalty : 0.0);
        }
        system.block<1, 3>(i, n) << 1, nodes[i].x, nodes[i].y;
        system.block<3, 1>(n, i) = system.block<1, 3>(i, n).transpose();
    }
    return system;
}

// Weights of the others for the light that is left out.
Eigen::RowVectorXd weightsWithout(std::span<const glm::vec2> nodes, size_t left, double penalty)
{
    std::vector<glm::vec2> others(nodes.begin(), nodes.end());
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left));
    const auto n = static_cast<Eigen::Index>(others.size());
    const glm::vec2 asked = pacedOutside(LightHull(others), nodes[left]);
    // The others may lie on a line: then the least of all factors that fit.
    const Eigen::MatrixXd factors = splineSystem(others, penalty).completeOrthogonalDecomposition().pseudoInverse();
    const Eigen::RowVectorXd weights = (splineTerms(others, asked) * factors).head(n);
    Eigen::RowVectorXd all = Eigen::RowVectorXd::Zero(n + 1);
    const auto at = static_cast<Eigen::Index>(left);
    all.head(at) = weights.head(at);
    all.tail(n - at) = weights.tail(n - at);
    return all;
}

bool isAmongOthers(std::span<const glm::vec2> nodes, size_t light)
{
    std::vector<glm::vec2> others(nodes.begin(), nodes.end());
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(light));
    return LightHull(others).contains(nodes[light]);
}

} // namespace

Eigen::MatrixXd splineFactors(std::span<const glm::vec2> nodes, double penalty)
{
    return splineSystem(nodes, penalty).partialPivLu().inverse().leftCols(static_cast<Eigen::Index>(nodes.size()));
}

Eigen::MatrixXd leaveOneOutWeights(std::span<const glm::vec2> nodes, double penalty)
{
    const auto n = static_cast<Eigen::Index>(nodes.size());
    const Eigen::MatrixXd inverse = splineFactors(nodes, penalty).topRows(n);
    Eigen::MatrixXd weights(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        if (isAmongOthers(nodes, static_cast<size_t>(i))) {
            weights.row(i) = -inverse.row(i) / inverse(i, i);
            weights(i, i) = 0;
        } else {
            weights.row(i) = weightsWithout(nodes, static_cast<size_t>(i), penalty);
        }
    }
    return weights;
}

} // namespace nacre
