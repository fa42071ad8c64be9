#include "acquisition/brdf/kernel_regression.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <nanoflann.hpp>

namespace nacre {

namespace {

constexpr size_t kLeafSize = 24;

// The paper's metric: the three angles as they are.
glm::vec3 anglesFromUnit(const TableDomain& domain, const glm::vec3& unit)
{
    if (domain.coordinates == kNatural) {
        const Natural c = naturalFromUnit(unit);
        return {c.thetaI, c.thetaO, c.phi};
    }
    const HalfDifference c = halfDifferenceFromUnit(unit, domain);
    return {c.thetaH, c.thetaD, c.phiD};
}

struct Points {
    std::vector<glm::vec3> angles;

    size_t kdtree_get_point_count() const { return angles.size(); }
    float kdtree_get_pt(size_t i, size_t axis) const { return angles[i][static_cast<int>(axis)]; }
    template <class Box> bool kdtree_get_bbox(Box&) const { return false; }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points, 3>;

} // namespace

struct KernelRegression::Index {
    BrdfSamples samples;
    Points points;
    size_t k;
    std::unique_ptr<Tree> tree;
};

KernelRegression::KernelRegression(const BrdfSamples& samples, int k)
    : index_(new Index{usableSamples(samples), {}, static_cast<size_t>(k), nullptr})
{
    const BrdfSamples& usable = index_->samples;
    index_->points.angles.reserve(usable.size());
    for (const glm::vec3& unit : usable.unit) {
        index_->points.angles.push_back(anglesFromUnit(usable.domain, unit));
    }
    index_->tree = std::make_unique<Tree>(3, index_->points, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafSize));
    index_->tree->buildIndex();
}

KernelRegression::~KernelRegression() = default;

InterpolatedValue KernelRegression::evaluate(const glm::vec3& unit) const
{
    std::array<uint32_t, kMostNeighbours + 1> found;
    std::array<float, kMostNeighbours + 1> squaredDistance;
    const glm::vec3 query = anglesFromUnit(index_->samples.domain, unit);
    const size_t wanted = index_->k + 1;
    const size_t count = index_->tree->knnSearch(&query.x, wanted, found.data(), squaredDistance.data());
    // Where fewer than k + 1 samples exist, the furthest must still weigh something.
    const float reach = squaredDistance[count - 1] * (count < wanted ? 1.2f : 1.0f);
    const float squaredBandwidth = std::max(reach, kBandwidthFloor * kBandwidthFloor);
    glm::vec3 sum(0);
    float weights = 0;
    for (size_t i = 0; i < count; ++i) {
        const float u2 = squaredDistance[i] / squaredBandwidth;
        const float weight = index_->samples.weights[found[i]] * 0.75f * std::max(0.0f, 1.0f - u2);
        sum += weight * index_->samples.values[found[i]];
        weights += weight;
    }
    if (!(weights > 0)) { // k + 1 equally distant neighbours
        for (size_t i = 0; i < count; ++i) {
            const float weight = index_->samples.weights[found[i]];
            sum += weight * index_->samples.values[found[i]];
            weights += weight;
        }
    }
    return {sum / weights, std::sqrt(squaredDistance[0])};
}

} // namespace nacre
