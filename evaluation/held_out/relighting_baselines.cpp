#include "evaluation/held_out/relighting_baselines.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <glm/geometric.hpp>

namespace nacre {

namespace {

using Directions = std::vector<glm::vec3>;

Eigen::MatrixXd polynomials(const Directions& directions)
{
    Eigen::MatrixXd basis(directions.size(), 6);
    for (size_t i = 0; i < directions.size(); ++i) {
        const double x = directions[i].x, y = directions[i].y;
        basis.row(static_cast<Eigen::Index>(i)) << x * x, y * y, x * y, x, y, 1;
    }
    return basis;
}

// H_l^m up to factors, which a least-squares fit does not feel: P_l^|m|(2 cos theta - 1) times cos or sin of m phi.
Eigen::MatrixXd harmonics(const Directions& directions, int order)
{
    Eigen::MatrixXd basis(directions.size(), (order + 1) * (order + 1));
    for (size_t i = 0; i < directions.size(); ++i) {
        const glm::vec3& d = directions[i];
        const double cosine = std::clamp(2.0 * d.z - 1.0, -1.0, 1.0), azimuth = std::atan2(d.y, d.x);
        Eigen::Index column = 0;
        for (int l = 0; l <= order; ++l) {
            for (int m = -l; m <= l; ++m) {
                const double legendre =
                    std::assoc_legendre(static_cast<unsigned>(l), static_cast<unsigned>(std::abs(m)), cosine);
                basis(static_cast<Eigen::Index>(i), column++) =
                    legendre * (m < 0 ? std::sin(-m * azimuth) : std::cos(m * azimuth));
            }
        }
    }
    return basis;
}

// asked (B'B + penalty)^-1 B', the penalty in units of the basis's own mean square; not on the last column if `spared`.
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

double thinPlate(const glm::vec3& a, const glm::vec3& b)
{
    const double x = a.x - b.x, y = a.y - b.y, r2 = x * x + y * y;
    return r2 > 0 ? 0.5 * r2 * std::log(r2) : 0.0;
}

Eigen::MatrixXd thinPlateWeights(double penalty, const Directions& given, const Directions& asked)
{
    const auto n = static_cast<Eigen::Index>(given.size()), m = static_cast<Eigen::Index>(asked.size());
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 3, n + 3), rows(m, n + 3);
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < n; ++j) {
            system(i, j) = thinPlate(given[i], given[j]) + (i == j ? penalty : 0.0);
        }
        system.block<1, 3>(i, n) << 1, given[i].x, given[i].y;
        system.block<3, 1>(n, i) = system.block<1, 3>(i, n).transpose();
    }
    for (Eigen::Index i = 0; i < m; ++i) {
        for (Eigen::Index j = 0; j < n; ++j) {
            rows(i, j) = thinPlate(asked[i], given[j]);
        }
        rows.block<1, 3>(i, n) << 1, asked[i].x, asked[i].y;
    }
    const Eigen::MatrixXd inverse = system.colPivHouseholderQr().inverse();
    return rows * inverse.leftCols(n);
}

Eigen::MatrixXd weightsOf(RelightingBaseline baseline, const Smoothing& smoothing, const Directions& given,
                          const Directions& asked)
{
    switch (baseline) {
    case RelightingBaseline::polynomialTextureMap:
        return ridgeWeights(polynomials(given), polynomials(asked), smoothing.penalty);
    case RelightingBaseline::hemisphericalHarmonics:
        return ridgeWeights(harmonics(given, 2), harmonics(asked, 2), smoothing.penalty);
    case RelightingBaseline::hemisphericalHarmonicsThird:
        return ridgeWeights(harmonics(given, 3), harmonics(asked, 3), smoothing.penalty);
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
