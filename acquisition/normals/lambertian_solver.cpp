#include "acquisition/normals/lambertian_solver.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <glm/geometric.hpp>

#include "engine/files/lanes.h"
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

// Of w l l^T and w l I over the observations whose weight w is above 0.
struct WeightedSums {
    Eigen::Matrix3d gram;
    Eigen::Vector3d right;
    double total = 0; // of the weights
    size_t used = 0;
};

NACRE_VECTOR_CLONES
WeightedSums weightedSums(const float* x, const float* y, const float* z, const float* intensities,
                          const float* weights, size_t count)
{
    Lanes xx = {}, xy = {}, xz = {}, yy = {}, yz = {}, zz = {}, right[3] = {}, total = {}, used = {};
    float lastIntensities[kLanes] = {}, lastWeights[kLanes] = {};
    const size_t whole = count / kLanes * kLanes;
    std::copy(intensities + whole, intensities + count, lastIntensities);
    std::copy(weights + whole, weights + count, lastWeights);
    for (size_t i = 0; i < count; i += kLanes) {
        const Lanes w = lanesAt(i < whole ? weights + i : lastWeights);
        const Lanes value = w > 0 ? lanesAt(i < whole ? intensities + i : lastIntensities) : allLanes(0);
        const Lanes wx = w * lanesAt(x + i), wy = w * lanesAt(y + i), wz = w * lanesAt(z + i);
        xx += wx * lanesAt(x + i);
        xy += wx * lanesAt(y + i);
        xz += wx * lanesAt(z + i);
        yy += wy * lanesAt(y + i);
        yz += wy * lanesAt(z + i);
        zz += wz * lanesAt(z + i);
        right[0] += wx * value;
        right[1] += wy * value;
        right[2] += wz * value;
        total += w;
        used += w > 0 ? allLanes(1) : allLanes(0);
    }
    WeightedSums sums;
    sums.gram << sumOf(xx), sumOf(xy), sumOf(xz), sumOf(xy), sumOf(yy), sumOf(yz), sumOf(xz), sumOf(yz), sumOf(zz);
    sums.right << sumOf(right[0]), sumOf(right[1]), sumOf(right[2]);
    sums.total = sumOf(total);
    sums.used = static_cast<size_t>(sumOf(used));
    return sums;
}

// Sum of w (I - l.g)^2 over the observations whose weight w is above 0.
NACRE_VECTOR_CLONES
float weightedSquares(const float* const directions[3], const glm::vec3& g, const float* intensities,
                      const float* weights, size_t count)
{
    const size_t whole = count / kLanes * kLanes;
    Lanes squares = {};
    for (size_t i = 0; i < whole; i += kLanes) {
        const Lanes w = lanesAt(weights + i);
        const Lanes missed =
            lanesAt(intensities + i) -
            (g.x * lanesAt(directions[0] + i) + g.y * lanesAt(directions[1] + i) + g.z * lanesAt(directions[2] + i));
        squares += w > 0 ? w * missed * missed : allLanes(0);
    }
    float sum = sumOf(squares);
    for (size_t i = whole; i < count; ++i) {
        const float missed =
            intensities[i] - (g.x * directions[0][i] + g.y * directions[1][i] + g.z * directions[2][i]);
        sum += weights[i] > 0 ? weights[i] * missed * missed : 0.0f;
    }
    return sum;
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
    const size_t padded = (lights.size() + kLanes - 1) / kLanes * kLanes;
    for (std::vector<float>* component : {&x_, &y_, &z_}) {
        component->resize(padded, 0.0f);
    }
    for (size_t i = 0; i < lights.size(); ++i) {
        directions_.push_back(lights[i].direction);
        x_[i] = lights[i].direction.x;
        y_[i] = lights[i].direction.y;
        z_[i] = lights[i].direction.z;
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
    const WeightedSums sums =
        weightedSums(x_.data(), y_.data(), z_.data(), intensities.data(), weights.data(), intensities.size());
    Eigen::Matrix3d inverse;
    if (sums.used < 3 || !pseudoInverse(sums.gram, inverse)) {
        return PixelNormal{};
    }
    const Eigen::Vector3d rhoN = inverse * sums.right;
    PixelNormal pixel = normalOf(rhoN, sums.used);
    const glm::vec3 g(rhoN.x(), rhoN.y(), rhoN.z());
    const float* const directions[] = {x_.data(), y_.data(), z_.data()};
    const double squares = weightedSquares(directions, g, intensities.data(), weights.data(), intensities.size());
    const double used = static_cast<double>(sums.used), freedom = std::max(1.0, used - 3) * sums.total / used;
    pixel.confidence *= confidenceOf(normalUncertainty(static_cast<float>(std::sqrt(squares / freedom)), pixel.albedo,
                                                       static_cast<float>(inverse.trace())));
    return pixel;
}

void LambertianSolver::project(const glm::vec3& v, std::span<float> dots) const
{
    for (size_t i = 0; i < dots.size(); ++i) {
        dots[i] = v.x * x_[i] + v.y * y_[i] + v.z * z_[i];
    }
}

void LambertianSolver::predict(const PixelNormal& pixel, std::span<float> predicted) const
{
    project(pixel.albedo * pixel.normal, predicted);
    for (float& value : predicted) {
        value = std::max(0.0f, value);
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
