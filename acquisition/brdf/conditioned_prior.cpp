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

// One row a node that has samples: log f - mean = A c, and its error's variance.
struct PriorRows {
    RowMajor A;
    Eigen::Matrix<float, Eigen::Dynamic, 3> y;
    Eigen::VectorXf variances;
};

PriorRows rowsOf(const MaterialPrior& prior, const Eigen::Map<const RowMajor>& components, const BrdfSamples& samples)
{
    const float bright = brightLevel(samples);
    const std::vector<NodeSamples> seen = samplesByNode(samples, bright);
    const auto count = static_cast<Eigen::Index>(seen.size());
    PriorRows rows{RowMajor::Zero(count, components.cols()), Eigen::MatrixX3f(count, 3), Eigen::VectorXf(count)};
    for (Eigen::Index i = 0; i < count; ++i) {
        const NodeSamples& node = seen[static_cast<size_t>(i)];
        const glm::vec3 unit(node.unit), logValue(node.logValue);
        const PriorNodes around = priorNodesAt(samples.domain, unit);
        float mean = 0, rest = 0;
        for (int corner = 0; corner < 8; ++corner) {
            rows.A.row(i) += around.weight[corner] * components.row(static_cast<Eigen::Index>(around.node[corner]));
            mean += around.weight[corner] * prior.mean[around.node[corner]];
            rest += around.weight[corner] * prior.rest[around.node[corner]];
        }
        const float cosine = lesserCosine(directionsFromUnit(samples.domain, unit));
        rows.variances(i) = squaredError(greyOf(glm::exp(logValue)), cosine, bright) + rest;
        rows.y.row(i) << logValue.x - mean, logValue.y - mean, logValue.z - mean;
    }
    return rows;
}

struct PriorFit {
    Eigen::LLT<Eigen::MatrixXf> precision;
    Eigen::Matrix<float, Eigen::Dynamic, 3> c;
    float misfit = 0;
};

// least: the least error of a row.
PriorFit fitRows(const PriorRows& rows, float least)
{
    const Eigen::VectorXf weights = (rows.variances.array() + least * least).inverse();
    Eigen::MatrixXf precision = rows.A.transpose() * weights.asDiagonal() * rows.A;
    precision.diagonal().array() += 1;
    PriorFit fit;
    fit.precision.compute(precision);
    fit.c = fit.precision.solve(rows.A.transpose() * weights.asDiagonal() * rows.y);
    if (weights.size() > 0) {
        const float squares = (rows.y - rows.A * fit.c).rowwise().squaredNorm().dot(weights) / 3;
        fit.misfit = std::sqrt(squares / weights.sum());
    }
    return fit;
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
    const auto nodes = static_cast<Eigen::Index>(prior.mean.size());
    const Eigen::Map<const RowMajor> components(prior.components.data(), nodes, prior.componentCount);
    const PriorRows rows = rowsOf(prior, components, samples);
    // Where the components cannot tell the samples, they are not bent to them.
    const PriorFit fit = fitRows(rows, std::max(kLeastError, fitRows(rows, kLeastError).misfit));
    const Eigen::Matrix<float, Eigen::Dynamic, 3> values = components * fit.c;
    const RowMajor spread = components * fit.precision.solve(Eigen::MatrixXf::Identity(fit.c.rows(), fit.c.rows()));
    ConditionedPrior conditioned;
    for (Eigen::Index i = 0; i < nodes; ++i) {
        const auto node = static_cast<size_t>(i);
        conditioned.logValues.push_back(prior.mean[node] + glm::vec3(values(i, 0), values(i, 1), values(i, 2)));
        conditioned.variances.push_back(spread.row(i).dot(components.row(i)) + prior.rest[node]);
    }
    conditioned.misfit = fit.misfit;
    return conditioned;
}

} // namespace nacre
