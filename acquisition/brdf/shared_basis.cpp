#include "acquisition/brdf/shared_basis.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace nacre {

namespace {

constexpr double kLeastBasisConfidence = 0.05f; // what was not measured still has to be something
constexpr double kLargestValue = 4096;          // of a component: far from both ends of a 16-bit float
constexpr double kLeastShare = 1e-10;           // of the largest eigenvalue: below, a component is rounding

// Texels by channels of materials, weighed so that squares add up to errors as they show.
struct WeighedColumns {
    Eigen::MatrixXd values;
    Eigen::VectorXd rowWeights;
    Eigen::VectorXd columnWeights;
};

WeighedColumns weighedColumns(std::span<const BasisMember> members)
{
    const Eigen::Index texels = static_cast<Eigen::Index>(members.front().table->values.size());
    const Eigen::Index columns = 3 * static_cast<Eigen::Index>(members.size());
    WeighedColumns result{Eigen::MatrixXd(texels, columns), Eigen::VectorXd(texels), Eigen::VectorXd(columns)};
    Eigen::VectorXd confidence = Eigen::VectorXd::Zero(texels);
    for (size_t m = 0; m < members.size(); ++m) {
        const BrdfTable& table = *members[m].table;
        confidence += Eigen::Map<const Eigen::VectorXf>(table.confidence.data(), texels).cast<double>();
        for (int c = 0; c < 3; ++c) {
            const Eigen::Index column = 3 * static_cast<Eigen::Index>(m) + c;
            result.columnWeights(column) = 1 / members[m].peak;
            for (Eigen::Index t = 0; t < texels; ++t) {
                result.values(t, column) = table.values[static_cast<size_t>(t)][c] * result.columnWeights(column);
            }
        }
    }
    confidence = (confidence / static_cast<double>(members.size())).cwiseMax(kLeastBasisConfidence).cwiseSqrt();
    const Eigen::VectorXd size = result.values.rowwise().norm() / std::sqrt(static_cast<double>(columns));
    result.rowWeights = confidence.cwiseQuotient(size.cwiseMax(1.0));
    result.values = result.rowWeights.asDiagonal() * result.values;
    return result;
}

} // namespace

std::vector<BasisBrdf> fitBasis(std::span<const BasisMember> members, int rank)
{
    const WeighedColumns columns = weighedColumns(members);
    const Eigen::MatrixXd gram = columns.values.transpose() * columns.values;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(gram);
    const Eigen::Index count = gram.rows(), texels = columns.values.rows();
    const auto isRounding = [&](Eigen::Index r) {
        return eigen.eigenvalues()(count - 1 - r) < kLeastShare * eigen.eigenvalues()(count - 1);
    };
    auto basis =
        std::make_shared<BrdfBasis>(BrdfBasis{members.front().table->size, members.front().table->domain, 0, {}});
    std::vector<BasisBrdf> models(members.size(), BasisBrdf{basis, {}});
    for (Eigen::Index r = 0; r < std::min<Eigen::Index>(rank, count) && (r == 0 || !isRounding(r)); ++r) {
        const Eigen::VectorXd direction = eigen.eigenvectors().col(count - 1 - r);
        Eigen::VectorXd component = (columns.values * direction).cwiseQuotient(columns.rowWeights);
        const double largest = std::max(component.cwiseAbs().maxCoeff(), 1e-20);
        component *= kLargestValue / largest;
        for (Eigen::Index t = 0; t < texels; ++t) {
            basis->components.push_back(throughHalf(static_cast<float>(component(t))));
        }
        for (Eigen::Index column = 0; column < count; ++column) {
            models[static_cast<size_t>(column / 3)].coefficients.push_back(
                static_cast<float>(direction(column) * largest / (kLargestValue * columns.columnWeights(column))));
        }
        ++basis->rank;
    }
    return models;
}

std::vector<BasisBrdf> truncated(std::span<const BasisBrdf> models, int rank)
{
    auto basis = std::make_shared<BrdfBasis>(*models.front().basis);
    const size_t texels = basis->components.size() / static_cast<size_t>(basis->rank);
    basis->rank = std::min(rank, basis->rank);
    basis->components.resize(texels * static_cast<size_t>(basis->rank));
    std::vector<BasisBrdf> fewer;
    for (const BasisBrdf& model : models) {
        fewer.push_back({basis, model.coefficients});
        fewer.back().coefficients.resize(size_t{3} * static_cast<size_t>(basis->rank));
    }
    return fewer;
}

} // namespace nacre
