#include "acquisition/residual/residual_judge.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace nacre {
namespace {

constexpr double kMostLeverage = 0.9; // a light that alone decides normals says little, but not nothing
constexpr double kLeastError = 1e-12;

// Share of each light's observation in its own Lambertian fit: the diagonal of L (L'L)^-1 L'.
Eigen::ArrayXf leverages(std::span<const Light> lights)
{
    Eigen::MatrixXd matrix(lights.size(), 3);
    for (size_t i = 0; i < lights.size(); ++i) {
        const glm::vec3& l = lights[i].direction;
        matrix.row(static_cast<Eigen::Index>(i)) << l.x, l.y, l.z;
    }
    const Eigen::MatrixXd hat = matrix * (matrix.transpose() * matrix).ldlt().solve(matrix.transpose());
    return hat.diagonal().array().max(0.0).min(kMostLeverage).cast<float>();
}

} // namespace

ResidualJudge::ResidualJudge(const ResidualRows& rows, std::span<const Light> lights, float peak)
    : scales_(3, lights.size())
{
    for (size_t i = 0; i < lights.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            scales_(c, static_cast<Eigen::Index>(i)) = lights[i].irradiance[c] / peak;
        }
    }
    truth_ = shown(rows.observed);
    const Eigen::ArrayXf kept = 1 - leverages(lights);
    unseen_ = rows.observed - (rows.observed - rows.predicted) * kept.inverse().matrix().asDiagonal();
}

Eigen::ArrayXXf ResidualJudge::shown(const Eigen::MatrixXf& rows) const
{
    Eigen::ArrayXXf values = rows.array();
    for (Eigen::Index light = 0; light < values.cols(); ++light) {
        for (Eigen::Index row = 0; row < values.rows(); ++row) {
            values(row, light) *= scales_(row % 3, light);
        }
    }
    return values.max(0.0f).min(1.0f);
}

Eigen::ArrayXd ResidualJudge::errors(const Eigen::MatrixXf& guess) const
{
    return (shown(guess) - truth_).square().colwise().mean().cast<double>().transpose();
}

double meanDecibels(const Eigen::ArrayXd& errors)
{
    return -10 * errors.max(kLeastError).log10().mean();
}

double pooledDecibels(const Eigen::ArrayXd& errors)
{
    return -10 * std::log10(std::max(errors.mean(), kLeastError));
}

} // namespace nacre
