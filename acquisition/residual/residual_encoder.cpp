#include "acquisition/residual/residual_encoder.h"

#include <algorithm>
#include <cmath>

#include "acquisition/residual/light_spline.h"
#include "engine/files/parallel_for.h"

namespace nacre {
namespace {

constexpr float kRangeReserve = 0.125f; // of the sample's range, on both sides
constexpr size_t kPixelsAtOnce = 128;

void setRanges(const Eigen::MatrixXf& amounts, ResidualLayer& layer)
{
    for (Eigen::Index k = 0; k < amounts.cols(); ++k) {
        const float low = amounts.col(k).minCoeff(), high = amounts.col(k).maxCoeff();
        const float reserve = kRangeReserve * std::max(high - low, 1e-12f);
        layer.low.push_back(low - reserve);
        layer.high.push_back(high + reserve);
    }
}

// The components' amounts under each captured light, as splines between them.
std::vector<glm::vec3> splinesOf(const Eigen::MatrixXf& basis, const std::vector<glm::vec2>& nodes, double penalty)
{
    const Eigen::MatrixXf factors = splineFactors(nodes, penalty).cast<float>();
    const auto lights = static_cast<Eigen::Index>(nodes.size());
    std::vector<glm::vec3> weights;
    for (Eigen::Index k = 0; k < basis.cols(); ++k) {
        Eigen::MatrixXf terms(factors.rows(), 3);
        for (Eigen::Index c = 0; c < 3; ++c) {
            terms.col(c) = factors * basis.col(k).segment(c * lights, lights);
        }
        for (Eigen::Index i = 0; i < terms.rows(); ++i) {
            weights.emplace_back(terms(i, 0), terms(i, 1), terms(i, 2));
        }
    }
    return weights;
}

} // namespace

ResidualEncoder::ResidualEncoder(const Surface& surface, const LightBalls& balls, const std::vector<glm::vec2>& nodes,
                                 const ResidualFit& fit, const ResidualRows& sample, Eigen::MatrixXf basis)
    : surface_(surface), balls_(balls), basis_(std::move(basis))
{
    layer.width = surface.normals.width;
    layer.height = surface.normals.height;
    layer.components = static_cast<int>(basis_.cols());
    layer.trust = fit.trust;
    layer.nodes = nodes;
    layer.weights = splinesOf(basis_, nodes, fit.penalty);
    layer.codes.assign(layer.layers() * layer.pixelCount() * kComponentsPerTexel, 0);
    setRanges(residualsOf(sample, fit.trust) * basis_, layer);
}

void ResidualEncoder::encodePixels(const Observations& block, std::span<const size_t> places)
{
    const Eigen::MatrixXf amounts = residualsOf(residualRows(block, places, surface_, balls_), layer.trust) * basis_;
    for (size_t p = 0; p < places.size(); ++p) {
        for (int k = 0; k < layer.components; ++k) {
            const float share =
                (amounts(static_cast<Eigen::Index>(p), k) - layer.low[k]) / (layer.high[k] - layer.low[k]);
            const size_t texel = (k / kComponentsPerTexel) * layer.pixelCount() + block.pixels[places[p]];
            layer.codes[texel * kComponentsPerTexel + k % kComponentsPerTexel] =
                static_cast<uint8_t>(std::lround(255 * std::clamp(share, 0.0f, 1.0f)));
        }
    }
}

void ResidualEncoder::encode(const Observations& block, int threads)
{
    const std::vector<size_t> places = shadedPlaces(block, surface_);
    parallelFor(places.size(), kPixelsAtOnce, threads, [&](size_t first, size_t last) {
        encodePixels(block, std::span(places).subspan(first, last - first));
    });
}

} // namespace nacre
