#include "acquisition/residual/residual_estimate.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "acquisition/residual/left_out.h"
#include "acquisition/residual/light_interpolation.h"
#include "acquisition/residual/residual_choice.h"
#include "acquisition/residual/residual_rows.h"
#include "engine/files/error.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

// Turns photographs, block by block, into a layer's component pictures of 8 bits, and its basis into weights.
class ResidualEncoder {
public:
    // `sample` sets the range of each component, with a reserve; what lies beyond is clamped. `basis`: orthonormal
    // columns over [channel * lights + light]. Surface and balls are referred to while the encoder lives.
    ResidualEncoder(const Surface& surface, const LightBalls& balls, const std::vector<glm::vec3>& nodes,
                    const ResidualFit& fit, const ResidualRows& sample, Eigen::MatrixXf basis);

    void encode(const Observations& block, int threads);

    ResidualLayer layer;

private:
    void encodePixels(const Observations& block, std::span<const size_t> places);

    const Surface& surface_;
    const LightBalls& balls_;
    Eigen::MatrixXf basis_;
};

constexpr float kRangeReserve = 0.125f; // of the sample's range, on both sides
constexpr size_t kEncodedAtOnce = 128;

void setRanges(const Eigen::MatrixXf& amounts, ResidualLayer& layer)
{
    for (Eigen::Index k = 0; k < amounts.cols(); ++k) {
        const float low = amounts.col(k).minCoeff(), high = amounts.col(k).maxCoeff();
        const float reserve = kRangeReserve * std::max(high - low, 1e-12f);
        layer.low.push_back(low - reserve);
        layer.high.push_back(high + reserve);
    }
}

// The layer's weights, from the components' amounts under each captured light.
std::vector<glm::vec3> weightsOf(const Eigen::MatrixXf& basis, const std::vector<glm::vec3>& nodes)
{
    const Eigen::MatrixXf factors = interpolationFactors(nodes).cast<float>();
    const auto lights = static_cast<Eigen::Index>(nodes.size());
    std::vector<glm::vec3> weights;
    for (Eigen::Index k = 0; k < basis.cols(); ++k) {
        const Eigen::Map<const Eigen::MatrixXf> amounts(basis.col(k).data(), lights, 3);
        const Eigen::MatrixXf channels = factors * amounts;
        for (Eigen::Index i = 0; i < lights; ++i) {
            weights.emplace_back(channels(i, 0), channels(i, 1), channels(i, 2));
        }
    }
    return weights;
}

ResidualEncoder::ResidualEncoder(const Surface& surface, const LightBalls& balls, const std::vector<glm::vec3>& nodes,
                                 const ResidualFit& fit, const ResidualRows& sample, Eigen::MatrixXf basis)
    : surface_(surface), balls_(balls), basis_(std::move(basis))
{
    layer.width = surface.normals.width;
    layer.height = surface.normals.height;
    layer.components = static_cast<int>(basis_.cols());
    layer.trust = fit.trust;
    layer.nodes = nodes;
    layer.weights = weightsOf(basis_, nodes);
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
    parallelFor(places.size(), kEncodedAtOnce, threads, [&](size_t first, size_t last) {
        encodePixels(block, std::span(places).subspan(first, last - first));
    });
}

constexpr size_t kMostUnasked = 40; // components: more cost a frame more than the last of them give (docs/results.md)
constexpr size_t kSmallestBall = 64;
constexpr double kBallLoss = kComponentsLoss / 5;
constexpr size_t kMostBallBytes = size_t{64} << 20;

// Far fewer texels than there are pixels, in bounded memory.
bool areQuick(const Surface& surface, size_t size, size_t pixels)
{
    const size_t texels = surface.materials.size() * size * size;
    return 2 * texels <= pixels && texels * 3 * surface.lights.size() * sizeof(float) <= kMostBallBytes;
}

// The smallest balls that are as good as the tables to the layer, where there are such: of no surface that is placed.
LightBalls quickBalls(const Surface& surface, const ResidualRows& rows, const ResidualJudge& judge,
                      const ResidualFit& fit, size_t pixels, int threads)
{
    for (size_t size = kSmallestBall; !isPlaced(surface) && areQuick(surface, size, pixels); size *= 2) {
        LightBalls balls(surface, static_cast<int>(size), threads);
        const Eigen::MatrixXf off =
            rows.observed + fit.trust * (predictedRows(balls, rows.pixels, surface.lights.size()) - rows.predicted);
        if (lossByErrors(fit, judge.errors(off)) <= kBallLoss) {
            return balls;
        }
    }
    return {surface, 0, threads};
}

// Bytes of one component: its picture on the shaded pixels and its weights.
size_t bytesPerComponent(size_t pixels, size_t lights)
{
    return pixels + lights * sizeof(glm::vec3);
}

} // namespace

EstimatedResidual estimateResidual(const Surface& surface, const ResidualOptions& options, const LeftOut& leftOut,
                                   ObservationBlocks& blocks)
{
    EstimatedResidual result;
    ResidualReport& report = result.report;
    report.choice = options.choice;
    report.whyNot = leftOut.whyNot;
    if (!report.whyNot.empty() && options.choice == ResidualChoice::difference) {
        throw Error("", "no residual layer can be made: " + report.whyNot,
                    fmt::format("{} lights or more, spread over a solid angle", kFewestResidualLights));
    }
    if (!report.whyNot.empty() || options.choice == ResidualChoice::none || leftOut.shadedPixels == 0) {
        return result;
    }
    const std::vector<glm::vec3> nodes = lightDirections(surface);
    const ResidualRows& rows = leftOut.rows;
    const ResidualJudge judge = judgeOf(surface, rows);
    report.fit = chooseResidualFit(rows, leftOut.unseen, nodes, judge, options.choice);
    const size_t each = bytesPerComponent(leftOut.shadedPixels, nodes.size());
    const size_t most = options.toleranceDecibels > 0 ? kMostResidualComponents : kMostUnasked;
    const size_t afforded = options.budgetBytes > 0 ? options.budgetBytes / each : most;
    if (report.fit.isKept && afforded == 0) {
        report.fit.isKept = false;
        report.whyNot = fmt::format("a component takes {} bytes, {} may be used", each, options.budgetBytes);
    }
    if (!report.fit.isKept) {
        return result;
    }
    const Eigen::MatrixXf basis = chooseComponents(rows, judge, options.toleranceDecibels,
                                                   std::min<size_t>(afforded, kMostResidualComponents), report);
    report.bytes = each * static_cast<size_t>(report.components);
    const LightBalls balls = quickBalls(surface, rows, judge, report.fit, leftOut.shadedPixels, options.threads);
    ResidualEncoder encoder(surface, balls, nodes, report.fit, rows, basis);
    while (const Observations* block = blocks.next()) {
        encoder.encode(*block, options.threads);
    }
    result.layer = std::move(encoder.layer);
    return result;
}

} // namespace nacre
