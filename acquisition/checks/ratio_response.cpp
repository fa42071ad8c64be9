#include "acquisition/checks/ratio_response.h"

#include <cmath>

#include <Eigen/Dense>
#include <glm/geometric.hpp>

#include "acquisition/normals/intensities.h"

namespace nacre {

namespace {

// Pixels, evenly spread, that tell how ratios answer to errors.
constexpr size_t kMostInResponse = 1000;
// Pixels whose lights left lie in one plane tell nothing: least over largest squared singular value.
constexpr double kLeastGramShare = 1e-4;

} // namespace

Eigen::MatrixXd responseOf(const NormalBlock& normals, const std::vector<Light>& lights)
{
    const Eigen::Index n = static_cast<Eigen::Index>(lights.size());
    const std::vector<size_t> pixels = spreadPixels(normals.pixels.size(), kMostInResponse);
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(n);
    // P = taken * taken^T
    Eigen::MatrixXd taken = Eigen::MatrixXd::Zero(n, 3 * static_cast<Eigen::Index>(pixels.size()));
    Eigen::MatrixX3d rows(n, 3);
    for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(pixels.size()); ++k) {
        const size_t p = pixels[k];
        Eigen::Matrix3d gram = Eigen::Matrix3d::Zero();
        rows.setZero();
        for (Eigen::Index i = 0; i < n; ++i) {
            const glm::vec3& l = lights[i].direction;
            const double cosine = glm::dot(normals.pixels[p].normal, l);
            const Verdict verdict = normals.verdicts[p * lights.size() + i];
            if (cosine > 0 && verdict != Verdict::shadow && verdict != Verdict::saturated) {
                weights(i) += cosine * cosine;
            }
            if (cosine > 0 && verdict == Verdict::used) {
                const Eigen::RowVector3d direction(l.x, l.y, l.z);
                gram += direction.transpose() * direction;
                rows.row(i) = cosine * direction;
            }
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(gram);
        if (solver.eigenvalues()(0) > kLeastGramShare * solver.eigenvalues()(2)) {
            taken.middleCols<3>(3 * k) = rows * solver.operatorInverseSqrt();
        }
    }
    Eigen::MatrixXd response = -taken * taken.transpose();
    response.diagonal() += weights;
    for (Eigen::Index i = 0; i < n; ++i) {
        if (weights(i) > 0) {
            response.row(i) /= weights(i);
        } else {
            response(i, i) = 1; // it turns no normal
        }
    }
    return response;
}

Eigen::VectorXd newtonStep(const MedianRatios& medians, const Eigen::VectorXd& missed, const Eigen::MatrixXd& all,
                           double prior, bool fixesScale)
{
    Eigen::MatrixXd response = all(medians.photographs, medians.photographs);
    const double count = static_cast<double>(medians.logs.size());
    response.diagonal().array() += prior + medians.logs.norm() / std::sqrt(count);
    if (fixesScale) {
        response.array() += 1 / count; // of the common factor, which no ratio tells
    }
    return response.partialPivLu().solve(missed);
}

} // namespace nacre
