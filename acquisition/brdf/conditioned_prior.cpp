#include "acquisition/brdf/conditioned_prior.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include "engine/files/measures.h"

namespace nacre {

namespace {

// Relative errors of a sample: least, of noise as a share of the bright level, of normals in radians.
constexpr float kLeastError = 0.02f;
constexpr float kNoise = 0.002f;
constexpr float kNormalError = 0.05f;
// Relative to each other: within a node no error is taken to be smaller.
constexpr float kLeastSampleError = 0.01f;
constexpr float kLeastMeasuredCosine = 0.05f;
// Of the grey value: the least that a channel's logarithm is taken of.
constexpr float kLeastChannel = 1e-4f;

using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

float lesserCosine(const LightView& d)
{
    return std::clamp(std::min(d.l.z, d.v.z), kLeastMeasuredCosine, 1.0f);
}

// The 99th percentile of f n.l.
float brightLevel(const BrdfSamples& samples)
{
    std::vector<float> radiance(samples.size());
    for (size_t i = 0; i < samples.size(); ++i) {
        radiance[i] = greyOf(samples.values[i]) * directionsFromUnit(samples.domain, samples.unit[i]).l.z;
    }
    const auto bright = radiance.begin() + static_cast<std::ptrdiff_t>(radiance.size() * 99 / 100);
    std::nth_element(radiance.begin(), bright, radiance.end());
    return std::max(*bright, 0.0f);
}

// The square of the relative error that noise and normals leave.
float squaredError(float grey, float cosine, float bright)
{
    const float noise = kNoise * bright / (grey * cosine);
    return noise * noise + kNormalError * kNormalError * (1 / (cosine * cosine) - 1);
}

// The samples about one node.
struct NodeSamples {
    double weight = 0;
    glm::dvec3 unit{0}, logValue{0};
};

std::vector<NodeSamples> samplesByNode(const BrdfSamples& samples, float bright)
{
    std::vector<NodeSamples> nodes(static_cast<size_t>(kPriorSize.x) * kPriorSize.y * kPriorSize.z);
    for (size_t i = 0; i < samples.size(); ++i) {
        const float grey = greyOf(samples.values[i]);
        if (!(grey > 0)) {
            continue;
        }
        const PriorNodes around = priorNodesAt(samples.domain, samples.unit[i]);
        const auto nearest = std::max_element(around.weight.begin(), around.weight.end()) - around.weight.begin();
        const float cosine = lesserCosine(directionsFromUnit(samples.domain, samples.unit[i]));
        const double weight = 1 / (squaredError(grey, cosine, bright) + kLeastSampleError * kLeastSampleError);
        NodeSamples& node = nodes[around.node[static_cast<size_t>(nearest)]];
        node.weight += weight;
        node.unit += weight * glm::dvec3(samples.unit[i]);
        node.logValue += weight * glm::dvec3(glm::log(glm::max(samples.values[i], kLeastChannel * grey)));
    }
    std::erase_if(nodes, [](const NodeSamples& node) { return !(node.weight > 0); });
    for (NodeSamples& node : nodes) {
        node.unit /= node.weight;
        node.logValue /= node.weight;
    }
    return nodes;
}

} // namespace

glm::vec3 ConditionedPrior::evaluate(const TableDomain& domain, const glm::vec3& unit) const
{
    const PriorNodes nodes = priorNodesAt(domain, unit);
    glm::vec3 sum(0);
    for (int corner = 0; corner < 8; ++corner) {
        sum += nodes.weight[corner] * logValues[nodes.node[corner]];
    }
    return glm::exp(sum);
}

float ConditionedPrior::variance(const TableDomain& domain, const glm::vec3& unit) const
{
    const PriorNodes nodes = priorNodesAt(domain, unit);
    float sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        sum += nodes.weight[corner] * variances[nodes.node[corner]];
    }
    return sum;
}

ConditionedPrior conditionedPrior(const MaterialPrior& prior, const BrdfSamples& samples)
{
    const float bright = brightLevel(samples);
    const std::vector<NodeSamples> seen = samplesByNode(samples, bright);
    const auto rows = static_cast<Eigen::Index>(seen.size()), nodes = static_cast<Eigen::Index>(prior.mean.size());
    const Eigen::Map<const RowMajor> components(prior.components.data(), nodes, prior.componentCount);
    RowMajor A = RowMajor::Zero(rows, prior.componentCount);
    Eigen::Matrix<float, Eigen::Dynamic, 3> y(rows, 3);
    Eigen::VectorXf weights(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
        const NodeSamples& node = seen[static_cast<size_t>(i)];
        const glm::vec3 unit(node.unit);
        const PriorNodes around = priorNodesAt(samples.domain, unit);
        float mean = 0, rest = 0;
        for (int corner = 0; corner < 8; ++corner) {
            A.row(i) += around.weight[corner] * components.row(static_cast<Eigen::Index>(around.node[corner]));
            mean += around.weight[corner] * prior.mean[around.node[corner]];
            rest += around.weight[corner] * prior.rest[around.node[corner]];
        }
        const float cosine = lesserCosine(directionsFromUnit(samples.domain, unit));
        const float grey = greyOf(glm::exp(glm::vec3(node.logValue)));
        weights(i) = 1 / (kLeastError * kLeastError + squaredError(grey, cosine, bright) + rest);
        y.row(i) << static_cast<float>(node.logValue.x) - mean, static_cast<float>(node.logValue.y) - mean,
            static_cast<float>(node.logValue.z) - mean;
    }
    Eigen::MatrixXf precision = A.transpose() * weights.asDiagonal() * A;
    precision.diagonal().array() += 1;
    const Eigen::LLT<Eigen::MatrixXf> solver(precision);
    const Eigen::Matrix<float, Eigen::Dynamic, 3> c = solver.solve(A.transpose() * weights.asDiagonal() * y);
    const Eigen::Matrix<float, Eigen::Dynamic, 3> left = y - A * c;
    const Eigen::Matrix<float, Eigen::Dynamic, 3> values = components * c;
    const RowMajor spread = components * solver.solve(Eigen::MatrixXf::Identity(c.rows(), c.rows()));
    ConditionedPrior conditioned;
    for (Eigen::Index i = 0; i < nodes; ++i) {
        const auto node = static_cast<size_t>(i);
        conditioned.logValues.push_back(prior.mean[node] + glm::vec3(values(i, 0), values(i, 1), values(i, 2)));
        conditioned.variances.push_back(spread.row(i).dot(components.row(i)) + prior.rest[node]);
    }
    if (rows > 0) {
        const float squares = left.rowwise().squaredNorm().dot(weights) / 3;
        conditioned.misfit = std::sqrt(squares / weights.sum());
    }
    return conditioned;
}

} // namespace nacre
