#include "acquisition/exemplar/held_out_lights.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "acquisition/exemplar/reflectance_fit.h"
#include "acquisition/lights/lights.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr size_t kFewestToHoldOut = 9;
constexpr size_t kHeldOutEvery = 6, kFirstHeldOut = 3;
// A cast shadow or a highlight costs no more than this, in roots over that of the pixel's bright level.
constexpr float kJuryTruncation = 0.16f;
constexpr int kJuryRounds = 2;
constexpr size_t kJuryPerTask = 256;

// The object's own reflectance, of the form asked for, as it follows from normals under the lights that are kept.
void measureReflectance(const Jury& jury, bool additive, int threads, MatchModel& model,
                        std::vector<BallMatch>& matches)
{
    model.ball = makeReflectanceBall(jury.grid, model.reflectance, threads);
    for (int round = 0; round <= kJuryRounds; ++round) {
        parallelFor(matches.size(), kJuryPerTask, threads, [&](size_t first, size_t last) {
            for (size_t p = first; p < last; ++p) {
                matches[p] = matchAtTexel(model, jury.kept, p, matches[p].texel, matches[p].scale);
            }
        });
        if (round < kJuryRounds) {
            fitReflectance(jury.kept, additive, threads, model, matches);
            model.ball = makeReflectanceBall(jury.grid, model.reflectance, threads);
        }
    }
}

} // namespace

std::optional<LightSplit> splitLights(const std::vector<Light>& lights)
{
    LightSplit split;
    for (size_t i = 0; i < lights.size(); ++i) {
        const bool isHeldOut = i % kHeldOutEvery == kFirstHeldOut;
        (isHeldOut ? split.heldOut : split.kept).push_back(i);
        (isHeldOut ? split.heldOutLights : split.keptLights).push_back(lights[i]);
    }
    if (lights.size() < kFewestToHoldOut || conditionOf(split.keptLights) > kWorstSpan) {
        return {};
    }
    return split;
}

Jury makeJury(const Intensities& sample, const LightSplit& split, int threads)
{
    Jury jury{split, makeThinLattice(selectLights(sample, split.kept), threads),
              makeBallGrid(kBallSize, split.keptLights, threads), selectLights(sample, split.heldOut),
              makeBallGrid(kBallSize, split.heldOutLights, threads)};
    // The lobes' bins of both are the same, since the lights that are kept say what was measured.
    jury.heldOutGrid.largestThetaD = jury.grid.largestThetaD;
    return jury;
}

std::vector<float> heldOutErrors(const Jury& jury, MatchModel model, const PixelLattice& lattice,
                                 const std::vector<BallMatch>& matches, int threads)
{
    model.ball = makeReflectanceBall(jury.heldOutGrid, model.reflectance, threads);
    std::vector<float> errors(matches.size());
    parallelFor(matches.size(), kJuryPerTask, threads, [&](size_t first, size_t last) {
        std::vector<float> predicted(jury.heldOut.lightCount);
        for (size_t p = first; p < last; ++p) {
            const float bright = lattice.bright[p];
            predictMatch(model, matches[p], bright, predicted.data());
            const std::span<const float> seen = jury.heldOut.ofPixel(lattice.rows[p]);
            float sum = 0, count = 0;
            for (size_t i = 0; i < predicted.size(); ++i) {
                if (!isClipped(seen[i])) {
                    const float observed = std::sqrt(std::max(seen[i] / bright, 0.0f));
                    sum += std::min(std::abs(observed - std::sqrt(predicted[i] / bright)) / kJuryTruncation, 1.0f);
                    ++count;
                }
            }
            errors[p] = count > 0 ? sum / count : 0;
        }
    });
    return errors;
}

std::vector<float> heldOutErrors(const Jury& jury, const std::vector<glm::vec3>& normals, int threads)
{
    std::vector<float> best;
    for (const bool additive : {false, true}) {
        std::vector<BallMatch> matches;
        for (const glm::vec3& normal : normals) {
            matches.push_back({ballTexelOf(normal, kBallSize), 1, 2, -1});
        }
        MatchModel model;
        measureReflectance(jury, additive, threads, model, matches);
        std::vector<float> errors = heldOutErrors(jury, std::move(model), jury.kept, matches, threads);
        if (best.empty() || meanOf(errors) < meanOf(best)) {
            best = std::move(errors);
        }
    }
    return best;
}

double meanOf(const std::vector<float>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(std::max<size_t>(1, values.size()));
}

} // namespace nacre
