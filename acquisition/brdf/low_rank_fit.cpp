#include "acquisition/brdf/low_rank_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/SVD>

namespace nacre {

LowRankTable lowRankOf(const BrdfTable& table, int rank)
{
    const Eigen::Index rows = 3 * table.size.x, columns = Eigen::Index{table.size.y} * table.size.z;
    Eigen::MatrixXf matrix(rows, columns);
    for (Eigen::Index column = 0; column < columns; ++column) {
        for (int i = 0; i < table.size.x; ++i) {
            const glm::vec3& f = table.values[static_cast<size_t>(column) * table.size.x + i];
            for (int c = 0; c < 3; ++c) {
                matrix(c * table.size.x + i, column) = f[c];
            }
        }
    }
    // Half way between absolute and relative errors.
    Eigen::VectorXf scale = matrix.rowwise().norm() / std::sqrt(static_cast<float>(columns));
    scale = scale.array().max(std::max(scale.maxCoeff(), std::numeric_limits<float>::min()) * 1e-4f).sqrt();
    const Eigen::BDCSVD<Eigen::MatrixXf> svd(scale.cwiseInverse().asDiagonal() * matrix,
                                             Eigen::ComputeThinU | Eigen::ComputeThinV);
    LowRankTable model{
        table.size, table.domain, std::min<int>(rank, static_cast<int>(std::min(rows, columns))), {}, {}};
    for (int r = 0; r < model.rank; ++r) {
        const Eigen::VectorXf profile = scale.cwiseProduct(svd.matrixU().col(r)) * svd.singularValues()(r);
        model.profiles.insert(model.profiles.end(), profile.data(), profile.data() + rows);
        model.slices.insert(model.slices.end(), svd.matrixV().col(r).data(), svd.matrixV().col(r).data() + columns);
    }
    return model;
}

LowRankTable truncated(const LowRankTable& model, int rank)
{
    LowRankTable fewer = model;
    fewer.rank = std::min(rank, model.rank);
    fewer.profiles.resize(size_t{3} * model.size.x * fewer.rank);
    fewer.slices.resize(static_cast<size_t>(model.size.y) * model.size.z * fewer.rank);
    return fewer;
}

} // namespace nacre
