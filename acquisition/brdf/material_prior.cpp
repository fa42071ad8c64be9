#include "acquisition/brdf/material_prior.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <glm/common.hpp>

#include "engine/brdf/brdf_tabulation.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

#include "acquisition/brdf/published_fits.inc"

// Nearer to the horizon than this cosine, fits of measurements that nobody could make there mean nothing.
constexpr float kLeastFittedCosine = 0.06f;
// Of a material's peak: less is taken for this, since its logarithm would outweigh all else.
constexpr float kLeastShareOfPeak = 1e-6f;
// Standard deviation of the free constant, in natural logarithms: any scale that a capture may have.
constexpr float kScaleDeviation = 3;
constexpr float kLeastRest = 1e-6f;

const size_t kNodes = static_cast<size_t>(kPriorSize.x) * kPriorSize.y * kPriorSize.z;

vec3 rgbAt(const float* row, int column)
{
    return {row[column], row[column + 1], row[column + 2]};
}

bool isFitted(const LightView& d)
{
    return std::min(d.l.z, d.v.z) > kLeastFittedCosine;
}

BrdfTable nodesOf(const BrdfModel& model)
{
    BrdfTable nodes(kPriorSize, kPriorDomain);
    for (int k = 0; k < kPriorSize.z; ++k) {
        for (int j = 0; j < kPriorSize.y; ++j) {
            for (int i = 0; i < kPriorSize.x; ++i) {
                const LightView d = nodes.directions(i, j, k);
                const size_t node = nodes.index(i, j, k);
                if (isFitted(d)) {
                    nodes.values[node] = evaluate(model, vec3(0, 0, 1), d.l, d.v);
                    nodes.confidence[node] = 1;
                }
            }
        }
    }
    fillUncovered(nodes);
    return nodes;
}

// Of the nodes that fits know about 1, of the others 0.
Eigen::VectorXf nodeWeights()
{
    const BrdfTable nodes(kPriorSize, kPriorDomain);
    Eigen::VectorXf weights(static_cast<Eigen::Index>(kNodes));
    for (int k = 0; k < kPriorSize.z; ++k) {
        for (int j = 0; j < kPriorSize.y; ++j) {
            for (int i = 0; i < kPriorSize.x; ++i) {
                weights(static_cast<Eigen::Index>(nodes.index(i, j, k))) = isFitted(nodes.directions(i, j, k));
            }
        }
    }
    return weights;
}

// Material by material log f of its grey value, less its mean over the weighted nodes.
Eigen::MatrixXf logColumns(const std::vector<BrdfTable>& tables, const Eigen::VectorXf& weights)
{
    Eigen::MatrixXf columns(weights.size(), static_cast<Eigen::Index>(tables.size()));
    for (Eigen::Index column = 0; column < columns.cols(); ++column) {
        Eigen::VectorXf f(weights.size());
        for (Eigen::Index i = 0; i < f.size(); ++i) {
            const vec3& value = tables[static_cast<size_t>(column)].values[static_cast<size_t>(i)];
            f(i) = value.x + value.y + value.z;
        }
        f = f.cwiseMax(kLeastShareOfPeak * f.maxCoeff()).array().log();
        columns.col(column) = f.array() - f.dot(weights) / weights.sum();
    }
    return columns;
}

} // namespace

MaterialPrior makeMaterialPrior(std::span<const BrdfModel> materials, int threads)
{
    std::vector<BrdfTable> tables(materials.size());
    parallelFor(materials.size(), 1, threads, [&](size_t first, size_t end) {
        for (size_t m = first; m < end; ++m) {
            tables[m] = nodesOf(materials[m]);
        }
    });
    const Eigen::VectorXf weights = nodeWeights();
    Eigen::MatrixXf columns = logColumns(tables, weights);
    const Eigen::Index count = columns.cols();
    const Eigen::VectorXf mean = columns.rowwise().mean();
    columns.colwise() -= mean;
    // Components of few columns and many rows: by the columns' products (Sirovich, Turbulence and the Dynamics of
    // Coherent Structures, 1987).
    const Eigen::MatrixXf weighted = weights.asDiagonal() * columns;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXf> products(weighted.transpose() * weighted);
    const Eigen::Index kept = std::min<Eigen::Index>(kPriorComponents, count - 1);
    Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> components(mean.size(), kept + 1);
    components.leftCols(kept) =
        columns * products.eigenvectors().rightCols(kept) / std::sqrt(static_cast<float>(count));
    const Eigen::VectorXf all = columns.rowwise().squaredNorm() / static_cast<float>(count);
    const Eigen::VectorXf rest = (all - components.leftCols(kept).rowwise().squaredNorm()).cwiseMax(kLeastRest);
    components.col(kept).setConstant(kScaleDeviation);
    return {{mean.begin(), mean.end()},
            {components.data(), components.data() + components.size()},
            {rest.begin(), rest.end()},
            static_cast<int>(kept + 1)};
}

std::vector<BrdfModel> publishedFits()
{
    std::vector<BrdfModel> fits;
    for (const float* f : kAbcFits) {
        fits.emplace_back(AbcModel{rgbAt(f, 0), rgbAt(f, 3), f[6], f[7], f[8]});
    }
    for (const float* f : kSgdFits) {
        fits.emplace_back(SgdModel{rgbAt(f, 0), rgbAt(f, 3), rgbAt(f, 6), rgbAt(f, 9), rgbAt(f, 12), rgbAt(f, 15),
                                   rgbAt(f, 18), rgbAt(f, 21), rgbAt(f, 24), rgbAt(f, 27), rgbAt(f, 30)});
    }
    return fits;
}

const MaterialPrior& publishedMaterialPrior()
{
    static const MaterialPrior prior = makeMaterialPrior(publishedFits(), 0);
    return prior;
}

PriorNodes priorNodesAt(const TableDomain& domain, const glm::vec3& unit)
{
    const vec3 place = unitFromHalfDifference(halfDifferenceFromUnit(unit, domain), kPriorDomain);
    const vec3 position = place * vec3(kPriorSize - 1);
    const glm::ivec3 low = glm::clamp(glm::ivec3(glm::floor(position)), glm::ivec3(0), kPriorSize - 2);
    const vec3 t = position - vec3(low);
    PriorNodes nodes;
    for (int corner = 0; corner < 8; ++corner) {
        const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
        nodes.node[corner] = static_cast<size_t>((low.z + k) * kPriorSize.y + low.y + j) * kPriorSize.x + low.x + i;
        nodes.weight[corner] = (i ? t.x : 1 - t.x) * (j ? t.y : 1 - t.y) * (k ? t.z : 1 - t.z);
    }
    return nodes;
}

} // namespace nacre
