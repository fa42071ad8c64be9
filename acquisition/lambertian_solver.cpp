#include <cmath>

#include <Eigen/Dense>
#include <glm/geometric.hpp>

#include "acquisition/normals.h"

namespace nacre {

namespace {

// A direction whose singular value is below this share of the largest is not determined by the lights left.
constexpr double kSmallestSingularShare = 0.01;

// V S^-2 V^T of the directions that are kept, from the eigenvectors of L L^T; false where they do not span space.
bool pseudoInverse(const Eigen::Matrix3d& gram, Eigen::Matrix3d& inverse)
{
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(gram);
    const Eigen::Vector3d& squares = solver.eigenvalues(); // ascending squares of the singular values
    if (!(squares(2) > 0) || squares(0) < kSmallestSingularShare * kSmallestSingularShare * squares(2)) {
        return false;
    }
    inverse = solver.eigenvectors() * squares.cwiseInverse().asDiagonal() * solver.eigenvectors().transpose();
    return true;
}

PixelNormal normalOf(const Eigen::Vector3d& rhoN, size_t used)
{
    PixelNormal result;
    const double rho = rhoN.norm();
    result.used = static_cast<uint16_t>(used);
    if (!(rho > 0) || !std::isfinite(rho) || rhoN.z() <= 0) {
        return result; // black, or turned away from the camera that sees it
    }
    const Eigen::Vector3d n = rhoN / rho;
    result.normal = glm::vec3(n.x(), n.y(), n.z());
    result.albedo = static_cast<float>(rho);
    result.confidence = 1;
    return result;
}

} // namespace

// The rows of the pseudo-inverse V S^-1 U^T, one per light.
struct LambertianSolver::Decomposition {
    std::vector<Eigen::Vector3d> rows;
};

LambertianSolver::LambertianSolver(const std::vector<Light>& lights) : all_(std::make_unique<Decomposition>())
{
    Eigen::MatrixXd matrix(lights.size(), 3);
    for (size_t i = 0; i < lights.size(); ++i) {
        const glm::vec3& d = lights[i].direction;
        directions_.push_back(d);
        matrix.row(static_cast<Eigen::Index>(i)) << d.x, d.y, d.z;
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(matrix, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::MatrixXd inverse = svd.solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.rows()));
    for (Eigen::Index i = 0; i < inverse.cols(); ++i) {
        all_->rows.emplace_back(inverse.col(i));
    }
}

LambertianSolver::~LambertianSolver() = default;

PixelNormal LambertianSolver::solve(std::span<const float> intensities) const
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (size_t i = 0; i < intensities.size(); ++i) {
        sum += all_->rows[i] * intensities[i];
    }
    return normalOf(sum, intensities.size());
}

PixelNormal LambertianSolver::solve(std::span<const float> intensities, std::span<const uint8_t> use) const
{
    Eigen::Matrix3d gram = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    size_t used = 0;
    for (size_t i = 0; i < intensities.size(); ++i) {
        if (use[i]) {
            const Eigen::Vector3d l(directions_[i].x, directions_[i].y, directions_[i].z);
            gram += l * l.transpose();
            right += l * intensities[i];
            ++used;
        }
    }
    Eigen::Matrix3d inverse;
    if (used < 3 || !pseudoInverse(gram, inverse)) {
        return PixelNormal{};
    }
    return normalOf(inverse * right, used);
}

} // namespace nacre
