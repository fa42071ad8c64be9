#include "acquisition/residual/principal_components.h"

#include <algorithm>
#include <cstdint>

#include <Eigen/Dense>

namespace nacre {
namespace {

constexpr int kIterations = 6;

// In [-1, 1), by a hash of the index (Steele et al., Fast Splittable Pseudorandom Number Generators, 2014).
float hashed(uint64_t index)
{
    uint64_t z = (index + 1) * 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return static_cast<float>(static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1);
}

Eigen::MatrixXf orthonormal(const Eigen::MatrixXf& columns)
{
    const Eigen::HouseholderQR<Eigen::MatrixXf> qr(columns);
    return qr.householderQ() * Eigen::MatrixXf::Identity(columns.rows(), columns.cols());
}

} // namespace

Eigen::MatrixXf principalComponents(const Eigen::MatrixXf& rows, int most)
{
    const Eigen::Index count = std::min({Eigen::Index{most}, rows.rows(), rows.cols()});
    Eigen::MatrixXf basis(rows.cols(), count);
    for (Eigen::Index i = 0; i < basis.size(); ++i) {
        basis(i) = hashed(static_cast<uint64_t>(i));
    }
    for (int i = 0; i < kIterations; ++i) {
        basis = orthonormal(rows.transpose() * (rows * basis));
    }
    const Eigen::MatrixXf projected = rows * basis;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXf> energies(projected.transpose() * projected);
    basis = basis * energies.eigenvectors().rowwise().reverse();
    for (Eigen::Index k = 0; k < count; ++k) {
        Eigen::Index largest = 0;
        basis.col(k).cwiseAbs().maxCoeff(&largest);
        basis.col(k) *= basis(largest, k) < 0 ? -1.0f : 1.0f;
    }
    return basis;
}

} // namespace nacre
