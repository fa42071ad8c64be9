#include "evaluation/held_out/relighting_baselines.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <glm/geometric.hpp>

#include "engine/lights/light_plane.h"
#include "engine/rti/rti_picture.h"

namespace nacre {

namespace {

using Directions = std::vector<glm::vec3>;

// A row of the basis's values for each direction.
template <class Terms> Eigen::MatrixXd rowsOf(const Directions& directions, const Terms& termsOf)
{
    Eigen::MatrixXd rows;
    for (size_t i = 0; i < directions.size(); ++i) {
        const std::vector<double> terms = termsOf(directions[i]);
        rows.conservativeResize(static_cast<Eigen::Index>(directions.size()), static_cast<Eigen::Index>(terms.size()));
        rows.row(static_cast<Eigen::Index>(i)) =
            Eigen::Map<const Eigen::RowVectorXd>(terms.data(), static_cast<Eigen::Index>(terms.size()));
    }
    return rows;
}

// asked (B'B + penalty)^-1 B', the penalty in units of the basis's own mean square.
Eigen::MatrixXd ridgeWeights(const Eigen::MatrixXd& given, const Eigen::MatrixXd& asked, double penalty)
{
    Eigen::MatrixXd normal = given.transpose() * given;
    const double scale = normal.trace() / static_cast<double>(normal.rows());
    normal.diagonal().array() += std::max(penalty, 1e-9) * scale;
    return asked * normal.ldlt().solve(given.transpose());
}

double meanSpacing(const Directions& directions)
{
    double sum = 0;
    for (size_t i = 0; i < directions.size(); ++i) {
        double nearest = 2;
        for (size_t j = 0; j < directions.size(); ++j) {
            nearest = i == j ? nearest : std::min<double>(nearest, glm::length(directions[i] - directions[j]));
        }
        sum += nearest;
    }
    return sum / static_cast<double>(directions.size());
}

Eigen::MatrixXd gaussians(const Directions& directions, const Directions& centres, double width)
{
    Eigen::MatrixXd basis(directions.size(), centres.size());
    for (size_t i = 0; i < directions.size(); ++i) {
        for (size_t j = 0; j < centres.size(); ++j) {
            const double r = glm::length(directions[i] - centres[j]) / width;
            basis(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = std::exp(-r * r);
        }
    }
    return basis;
}

// K + penalty I solved against the identity; the kernel is positive definite.
Eigen::MatrixXd gaussianWeights(const Smoothing& smoothing, const Directions& given, const Directions& asked)
{
    const double width = smoothing.width * meanSpacing(given);
    Eigen::MatrixXd kernel = gaussians(given, given, width);
    kernel.diagonal().array() += std::max<double>(smoothing.penalty, 1e-9);
    return kernel.ldlt().solve(gaussians(asked, given, width).transpose()).transpose();
}

// r^2 log r of the distance (Wahba, Spline Models for Observational Data, 1990, Eq. 2.4).
double thinPlateKernel(const glm::vec2& a, const glm::vec2& b)
{
    const double r2 = double{glm::dot(a - b, a - b)};
    return r2 > 0 ? 0.5 * r2 * std::log(r2) : 0.0;
}

// Each node's kernel at a point, then 1, x and y.
Eigen::RowVectorXd splineTerms(const std::vector<glm::vec2>& nodes, const glm::vec2& point)
{
    const auto n = static_cast<Eigen::Index>(nodes.size());
    Eigen::RowVectorXd terms(n + 3);
    for (Eigen::Index i = 0; i < n; ++i) {
        terms(i) = thinPlateKernel(point, nodes[i]);
    }
    terms.tail<3>() << 1, point.x, point.y;
    return terms;
}

// Smoothing thin-plate splines over the plane of lights, affine part free (Wahba, Eq. 2.4.24).
Eigen::MatrixXd thinPlateWeights(double penalty, const Directions& given, const Directions& asked)
{
    const std::vector<glm::vec2> nodes = lightPlanePoints(given);
    const auto n = static_cast<Eigen::Index>(nodes.size());
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 3, n + 3);
    for (Eigen::Index i = 0; i < n; ++i) {
        system.row(i) = splineTerms(nodes, nodes[i]);
        system(i, i) += penalty;
        system.block<3, 1>(n, i) = system.block<1, 3>(i, n).transpose();
    }
    const Eigen::MatrixXd factors = system.partialPivLu().inverse().leftCols(n);
    Eigen::MatrixXd weights(static_cast<Eigen::Index>(asked.size()), n);
    for (size_t i = 0; i < asked.size(); ++i) {
        weights.row(static_cast<Eigen::Index>(i)) = splineTerms(nodes, lightPlanePoint(asked[i])) * factors;
    }
    return weights;
}

Eigen::MatrixXd weightsOf(RelightingBaseline baseline, const Smoothing& smoothing, const Directions& given,
                          const Directions& asked)
{
    const auto fitted = [&](const auto& terms) {
        return ridgeWeights(rowsOf(given, terms), rowsOf(asked, terms), smoothing.penalty);
    };
    switch (baseline) {
    case RelightingBaseline::polynomialTextureMap:
        return fitted([](const glm::vec3& light) { return rtiWeights(RtiBasis::ptm, light); });
    case RelightingBaseline::hemisphericalHarmonics:
        return fitted([](const glm::vec3& light) { return hemisphericalHarmonics(light, 2); });
    case RelightingBaseline::hemisphericalHarmonicsThird:
        return fitted([](const glm::vec3& light) { return hemisphericalHarmonics(light, 3); });
    case RelightingBaseline::radialBasisFunctions:
        return gaussianWeights(smoothing, given, asked);
    case RelightingBaseline::thinPlateSpline:
        break;
    }
    return thinPlateWeights(smoothing.penalty, given, asked);
}

} // namespace

std::string nameOf(RelightingBaseline baseline)
{
    switch (baseline) {
    case RelightingBaseline::polynomialTextureMap:
        return "PTM";
    case RelightingBaseline::hemisphericalHarmonics:
        return "HSH 9";
    case RelightingBaseline::hemisphericalHarmonicsThird:
        return "HSH 16";
    case RelightingBaseline::radialBasisFunctions:
        return "RBF";
    case RelightingBaseline::thinPlateSpline:
        break;
    }
    return "TPS";
}

std::vector<Smoothing> smoothingsOf(RelightingBaseline baseline)
{
    const float penalties[] = {0, 1e-5f, 1e-4f, 1e-3f, 3e-3f, 1e-2f, 3e-2f, 1e-1f, 3e-1f, 1};
    std::vector<Smoothing> smoothings;
    for (const float penalty : penalties) {
        if (baseline == RelightingBaseline::radialBasisFunctions) {
            for (const float width : {1.0f, 1.5f, 2.0f, 3.0f, 5.0f, 8.0f}) {
                smoothings.push_back({penalty, width});
            }
        } else {
            smoothings.push_back({penalty, 1});
        }
    }
    return smoothings;
}

std::vector<float> relightingWeights(RelightingBaseline baseline, const Smoothing& smoothing,
                                     const std::vector<glm::vec3>& given, const std::vector<glm::vec3>& asked)
{
    const Eigen::MatrixXd weights = weightsOf(baseline, smoothing, given, asked);
    std::vector<float> flat;
    for (Eigen::Index i = 0; i < weights.rows(); ++i) {
        for (Eigen::Index j = 0; j < weights.cols(); ++j) {
            flat.push_back(static_cast<float>(weights(i, j)));
        }
    }
    return flat;
}

} // namespace nacre
