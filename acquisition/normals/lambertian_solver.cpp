#include "acquisition/normals/lambertian_solver.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <glm/geometric.hpp>

#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

// A direction whose singular value is below this share of the largest is not determined by the lights left.
constexpr double kSmallestSingularShare = 0.01;
constexpr size_t kPixelsPerTask = 512;

Eigen::Vector3d eigenVector(const glm::vec3& v)
{
    return {v.x, v.y, v.z};
}

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
    double inverseGramTrace = 0;
};

LambertianSolver::LambertianSolver(const std::vector<Light>& lights) : all_(std::make_unique<Decomposition>())
{
    Eigen::MatrixXd matrix(lights.size(), 3);
    for (size_t i = 0; i < lights.size(); ++i) {
        directions_.push_back(lights[i].direction);
        matrix.row(static_cast<Eigen::Index>(i)) = eigenVector(lights[i].direction);
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(matrix, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::MatrixXd inverse = svd.solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.rows()));
    for (Eigen::Index i = 0; i < inverse.cols(); ++i) {
        all_->rows.emplace_back(inverse.col(i));
        all_->inverseGramTrace += inverse.col(i).squaredNorm();
    }
}

LambertianSolver::~LambertianSolver() = default;
LambertianSolver::LambertianSolver(LambertianSolver&&) noexcept = default;

PixelNormal LambertianSolver::solve(std::span<const float> intensities) const
{
    if (std::any_of(intensities.begin(), intensities.end(), isClipped)) {
        std::vector<float> weights;
        for (const float intensity : intensities) {
            weights.push_back(isClipped(intensity) ? 0.0f : 1.0f);
        }
        return solve(intensities, weights);
    }
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (size_t i = 0; i < intensities.size(); ++i) {
        sum += all_->rows[i] * intensities[i];
    }
    PixelNormal pixel = normalOf(sum, intensities.size());
    double squares = 0;
    for (size_t i = 0; i < intensities.size(); ++i) {
        const double r = intensities[i] - sum.dot(eigenVector(directions_[i]));
        squares += r * r;
    }
    const double freedom = std::max<double>(1, static_cast<double>(intensities.size()) - 3);
    pixel.confidence *= confidenceOf(normalUncertainty(static_cast<float>(std::sqrt(squares / freedom)), pixel.albedo,
                                                       static_cast<float>(all_->inverseGramTrace)));
    return pixel;
}

PixelNormal LambertianSolver::solve(std::span<const float> intensities, std::span<const float> weights) const
{
    Eigen::Matrix3d gram = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    size_t used = 0;
    double total = 0;
    for (size_t i = 0; i < intensities.size(); ++i) {
        if (weights[i] > 0) {
            const Eigen::Vector3d l = eigenVector(directions_[i]);
            gram += weights[i] * l * l.transpose();
            right += weights[i] * l * intensities[i];
            total += weights[i];
            ++used;
        }
    }
    Eigen::Matrix3d inverse;
    if (used < 3 || !pseudoInverse(gram, inverse)) {
        return PixelNormal{};
    }
    const Eigen::Vector3d rhoN = inverse * right;
    PixelNormal pixel = normalOf(rhoN, used);
    double squares = 0;
    for (size_t i = 0; i < intensities.size(); ++i) {
        if (weights[i] > 0) {
            const double r = intensities[i] - rhoN.dot(eigenVector(directions_[i]));
            squares += weights[i] * r * r;
        }
    }
    const double freedom = std::max(1.0, static_cast<double>(used) - 3) * total / static_cast<double>(used);
    pixel.confidence *= confidenceOf(normalUncertainty(static_cast<float>(std::sqrt(squares / freedom)), pixel.albedo,
                                                       static_cast<float>(inverse.trace())));
    return pixel;
}

void LambertianSolver::predict(const PixelNormal& pixel, std::span<float> predicted) const
{
    for (size_t i = 0; i < predicted.size(); ++i) {
        predicted[i] = pixel.albedo * std::max(0.0f, glm::dot(pixel.normal, directions_[i]));
    }
}

NormalBlock solveBlock(const Intensities& intensities, const LambertianSolver& solver, int threads,
                       const std::function<PixelNormal(size_t, std::span<const float>)>& solve)
{
    NormalBlock block;
    const size_t n = intensities.lightCount;
    block.pixels.resize(intensities.pixelCount());
    block.verdicts.resize(intensities.pixelCount() * n);
    parallelFor(block.pixels.size(), kPixelsPerTask, threads, [&](size_t first, size_t last) {
        std::vector<float> predicted(n);
        for (size_t p = first; p < last; ++p) {
            block.pixels[p] = solve(p, intensities.ofPixel(p));
            solver.predict(block.pixels[p], predicted);
            judge(intensities.ofPixel(p), predicted, std::span(block.verdicts).subspan(p * n, n));
        }
    });
    return block;
}

} // namespace nacre
