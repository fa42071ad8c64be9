#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "acquisition/exemplar/exemplar_model.h"
#include "acquisition/exemplar/exemplar_polish.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr size_t kPixelsPerTask = 64;
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
    parallelFor(pixels, kPixelsPerTask, threads, [&](size_t first, size_t last) {
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
    parallelFor(intensities.pixelCount(), kPixelsPerTask, threads, [&](size_t first, size_t last) {
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

} // namespace nacre
