#include <cmath>
#include <memory>

#include <Eigen/Dense>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "acquisition/exemplar/exemplar_model.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr size_t kMatchedPerTask = 64;
// Residuals are truncated at this share of the pixel's bright level.
constexpr float kLimitShare = 0.15f;
// Around a coarse match: a little more than the coarse ball's texels in the middle of the disc.
const float kCosFine = std::cos(glm::radians(6.0f));
const float kCosReestimate = std::cos(glm::radians(5.0f));

struct PixelMatch {
    glm::vec3 normal;
    Match match;
};

PixelMatch matchFine(const Exemplar& exemplar, const MatchTarget& target, const glm::vec3& start, float cosRadius)
{
    const Match match = findBestMatch(exemplar.fine, target, start, cosRadius, exemplar.scales);
    if (match.row < 0) {
        return {start, match};
    }
    const glm::vec3 between = refinedNormal(exemplar.fine, target, match, exemplar.scales);
    const PolishedMatch polished = polishedMatch(exemplar.fine, target, match, between, exemplar.scales);
    return {polished.normal, {match.cost, polished.scale, match.row}};
}

// The first exemplar searches widely; all search finely around what it found, and the mean of their normals counts.
PixelMatch matchExemplars(const ExemplarModel& model, const MatchTarget& target, const glm::vec3& start)
{
    const Exemplar& first = model.exemplars.front();
    const Match wide = findBestMatch(first.coarse, target, start, model.cosRadius, first.scales);
    const PixelMatch best = matchFine(first, target, wide.row < 0 ? start : first.coarse.normals[wide.row], kCosFine);
    glm::vec3 sum = best.normal;
    for (size_t e = 1; e < model.exemplars.size(); ++e) {
        sum += matchFine(model.exemplars[e], target, best.normal, kCosFine).normal;
    }
    return {glm::normalize(sum), best.match};
}

} // namespace

MatchTarget targetOf(const Intensities& intensities, size_t pixel, const std::vector<float>& weights)
{
    const float limit = kLimitShare * brightLevel(intensities.ofPixel(pixel));
    return {intensities.padded(pixel), nullptr, weights.data(), std::max(limit, std::numeric_limits<float>::min())};
}

ExemplarResult matchBlock(const ExemplarModel& model, const Intensities& intensities,
                          const std::vector<glm::vec3>& starts, const std::vector<float>& weights, int threads)
{
    const size_t pixels = intensities.pixelCount();
    ExemplarResult result{std::vector<glm::vec3>(pixels), std::vector<float>(pixels)};
    parallelFor(pixels, kMatchedPerTask, threads, [&](size_t first, size_t last) {
        for (size_t p = first; p < last; ++p) {
            const PixelMatch best = matchExemplars(model, targetOf(intensities, p, weights), starts[p]);
            result.normals[p] = best.normal;
            result.scales[p] = best.match.scale;
        }
    });
    for (const Exemplar& own : model.reestimated) {
        refineBlock(own, intensities, weights, threads, result);
    }
    return result;
}

void refineBlock(const Exemplar& own, const Intensities& intensities, const std::vector<float>& weights, int threads,
                 ExemplarResult& result)
{
    parallelFor(intensities.pixelCount(), kMatchedPerTask, threads, [&](size_t first, size_t last) {
        for (size_t p = first; p < last; ++p) {
            const PixelMatch match =
                matchFine(own, targetOf(intensities, p, weights), result.normals[p], kCosReestimate);
            result.normals[p] = match.normal;
            result.scales[p] = match.match.scale;
        }
    });
}

double predictionCost(const Exemplar& exemplar, const Intensities& intensities, const ExemplarResult& result,
                      const std::vector<float>& judged)
{
    double sum = 0;
    std::vector<float> column(exemplar.fine.stride);
    for (size_t p = 0; p < intensities.pixelCount(); ++p) {
        exemplar.fine.mixColumns(result.normals[p], column.data());
        sum += matchCost(column.data(), column.size(), targetOf(intensities, p, judged), result.scales[p]);
    }
    return sum / static_cast<double>(intensities.pixelCount());
}

namespace {

constexpr size_t kExemplarPixelsPerTask = 512;

std::vector<glm::vec3> startsOf(const NormalBlock& consensus)
{
    std::vector<glm::vec3> starts;
    for (const PixelNormal& pixel : consensus.pixels) {
        starts.push_back(pixel.albedo > 0 ? pixel.normal : glm::vec3(0, 0, 1));
    }
    return starts;
}

// From the scatter of the used residuals through the lights that are left, as for Lambertian pixels.
float confidenceOf(std::span<const float> observed, std::span<const float> predicted, std::span<const Verdict> verdicts,
                   const std::vector<Light>& lights)
{
    Eigen::Matrix3d gram = Eigen::Matrix3d::Zero();
    double squares = 0, brightness = 0;
    size_t used = 0;
    for (size_t i = 0; i < observed.size(); ++i) {
        if (verdicts[i] == Verdict::used) {
            const Eigen::Vector3d l(lights[i].direction.x, lights[i].direction.y, lights[i].direction.z);
            gram += l * l.transpose();
            squares += (observed[i] - predicted[i]) * (observed[i] - predicted[i]);
            brightness += observed[i];
            ++used;
        }
    }
    if (used < 3 || !(gram.determinant() > 0)) {
        return 0;
    }
    const double scatter = std::sqrt(squares / std::max<double>(1, static_cast<double>(used) - 3));
    return nacre::confidenceOf(normalUncertainty(static_cast<float>(scatter),
                                                 static_cast<float>(brightness / static_cast<double>(used)),
                                                 static_cast<float>(gram.inverse().trace())));
}

struct ExemplarSetup {
    std::vector<Light> lights;
    std::vector<float> weights;
    NormalEstimator consensus;
    ExemplarModel model;
    int threads;
};

void fillPixels(const ExemplarSetup& setup, const Intensities& intensities, const ExemplarResult& result,
                NormalBlock& block)
{
    const size_t n = intensities.lightCount;
    const Exemplar& last = lastExemplar(setup.model);
    parallelFor(block.pixels.size(), kExemplarPixelsPerTask, setup.threads, [&](size_t first, size_t end) {
        std::vector<float> predicted(last.fine.stride);
        for (size_t p = first; p < end; ++p) {
            last.fine.mixColumns(result.normals[p], predicted.data());
            std::transform(predicted.begin(), predicted.end(), predicted.begin(),
                           [&](float v) { return v * result.scales[p]; });
            const auto verdicts = std::span<const Verdict>(block.verdicts).subspan(p * n, n);
            const bool found = result.scales[p] > 0;
            const float confidence =
                found ? confidenceOf(intensities.ofPixel(p), std::span(predicted).first(n), verdicts, setup.lights)
                      : 0.0f;
            const auto used = std::count(verdicts.begin(), verdicts.end(), Verdict::used);
            block.pixels[p] = {found ? result.normals[p] : glm::vec3(0), result.scales[p], confidence,
                               static_cast<uint16_t>(used)};
        }
    });
}

} // namespace

NormalEstimator makeExemplarEstimator(const Intensities& sample, const std::vector<Light>& lights,
                                      const NormalOptions& options, std::vector<Finding>& findings)
{
    const auto setup = std::make_shared<ExemplarSetup>();
    setup->lights = lights;
    setup->weights = allLights(lights.size());
    setup->threads = options.threads;
    setup->consensus = makeConsensusEstimator(lights, options);
    setup->model = makeExemplarModel(sample, startsOf(setup->consensus(sample)), lights, options, findings);
    return [setup](const Intensities& intensities) {
        const std::vector<glm::vec3> starts = startsOf(setup->consensus(intensities));
        const ExemplarResult result = matchBlock(setup->model, intensities, starts, setup->weights, setup->threads);
        NormalBlock block{std::vector<PixelNormal>(intensities.pixelCount()),
                          judgeByExemplar(lastExemplar(setup->model), intensities, result, setup->threads)};
        fillPixels(*setup, intensities, result, block);
        return block;
    };
}

} // namespace nacre
