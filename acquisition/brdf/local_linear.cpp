#include "acquisition/brdf/local_linear.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <nanoflann.hpp>

namespace nacre {

namespace {

constexpr size_t kPlaneLeafSize = 16;
// Of the slopes, in units of the neighbours' own spread: only what they do not determine is held at 0.
constexpr float kRidge = 1e-3f;

// Constant and slopes along the four axes, for three channels.
using Moments = Eigen::Matrix<float, 5, 5>;
using Plane = Eigen::Matrix<float, 5, 3>;

struct EmbeddedPoints {
    std::vector<glm::vec4> points;

    size_t kdtree_get_point_count() const { return points.size(); }
    float kdtree_get_pt(size_t i, size_t axis) const { return points[i][static_cast<int>(axis)]; }
    template <class Box> bool kdtree_get_bbox(Box&) const { return false; }
};

using EmbeddedTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, EmbeddedPoints>, EmbeddedPoints, 4>;

glm::vec3 cubeRoot(const glm::vec3& v)
{
    return {std::cbrt(v.x), std::cbrt(v.y), std::cbrt(v.z)};
}

} // namespace

struct LocalLinearRegression::Index {
    TableDomain domain;
    SampleMetric metric;
    size_t k;
    std::vector<glm::vec3> unit;
    std::vector<glm::vec3> roots;
    std::vector<float> weights;
    EmbeddedPoints points;
    std::unique_ptr<EmbeddedTree> tree;
};

LocalLinearRegression::LocalLinearRegression(const BrdfSamples& samples, const SampleMetric& metric, int k)
    : index_(new Index{samples.domain, metric, static_cast<size_t>(k), samples.unit, {}, samples.weights, {}, nullptr})
{
    index_->roots.resize(samples.size());
    std::transform(samples.values.begin(), samples.values.end(), index_->roots.begin(), cubeRoot);
    index_->points.points.reserve(samples.size());
    for (const glm::vec3& unit : samples.unit) {
        index_->points.points.push_back(embeddedPoint(embeddedConfiguration(samples.domain, unit), metric));
    }
    index_->tree =
        std::make_unique<EmbeddedTree>(4, index_->points, nanoflann::KDTreeSingleIndexAdaptorParams(kPlaneLeafSize));
    index_->tree->buildIndex();
}

LocalLinearRegression::~LocalLinearRegression() = default;

InterpolatedValue LocalLinearRegression::evaluate(const glm::vec3& unit) const
{
    std::array<uint32_t, kMostNeighbours + 1> found;
    std::array<float, kMostNeighbours + 1> squaredDistance;
    const glm::vec4 query = embeddedPoint(embeddedConfiguration(index_->domain, unit), index_->metric);
    const size_t wanted = index_->k + 1;
    const size_t count = index_->tree->knnSearch(&query.x, wanted, found.data(), squaredDistance.data());
    // Where fewer than k + 1 samples exist, the furthest must still weigh something.
    const float reach = squaredDistance[count - 1] * (count < wanted ? 1.21f : 1.0f);
    const float squaredBandwidth = std::max(reach, kBandwidthFloor * kBandwidthFloor);
    // k + 1 equally distant neighbours would all weigh nothing.
    const bool equallyFar = count > 1 && !(squaredDistance[0] < squaredBandwidth);
    const float perBandwidth = 1 / std::sqrt(squaredBandwidth);
    Moments moments = Moments::Zero();
    Plane sums = Plane::Zero();
    glm::vec3 low(1e30f), high(-1e30f);
    for (size_t i = 0; i < count; ++i) {
        const uint32_t j = found[i];
        const float kernel = equallyFar ? 1.0f : 1 - squaredDistance[i] / squaredBandwidth;
        if (!(kernel > 0)) {
            continue;
        }
        const float weight = kernel * index_->weights[j] * index_->weights[j];
        const glm::vec4 offset = (index_->points.points[j] - query) * perBandwidth;
        const glm::vec3& root = index_->roots[j];
        Eigen::Matrix<float, 5, 1> x;
        x << 1, offset.x, offset.y, offset.z, offset.w;
        moments.noalias() += x * (weight * x).transpose();
        sums.noalias() += x * (weight * Eigen::RowVector3f(root.x, root.y, root.z));
        low = glm::min(low, root);
        high = glm::max(high, root);
    }
    const float total = moments(0, 0);
    moments /= total;
    moments.diagonal().tail<4>().array() += kRidge;
    const Plane plane = moments.llt().solve(sums / total);
    const glm::vec3 overshoot = kOvershoot * (high - low);
    const glm::vec3 root =
        glm::clamp(glm::vec3(plane(0, 0), plane(0, 1), plane(0, 2)), glm::max(low - overshoot, glm::vec3(0)),
                   glm::max(high + overshoot, glm::vec3(0)));
    return {root * root * root, angularDistance(index_->domain, unit, index_->unit[found[0]])};
}

} // namespace nacre
