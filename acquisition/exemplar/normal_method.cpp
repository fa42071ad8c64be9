#include "acquisition/exemplar/normal_method.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "acquisition/exemplar/exemplar_estimator.h"
#include "acquisition/exemplar/exemplar_model.h"
#include "acquisition/exemplar/reflectance_fit.h"
#include "acquisition/lights/lights.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr size_t kFewestToHoldOut = 9;
constexpr size_t kHeldOutEvery = 6, kFirstHeldOut = 3;
// Errors this close are a tie: 2 %, and what the table's own grain makes, in units of the truncation limit.
constexpr double kTieShare = 0.02;
constexpr double kTieDifference = 0.002;
// Beyond it more than half of what is predicted is as wrong as counts: the errors no longer tell methods apart.
constexpr double kUnexplained = 0.5;
// A cast shadow or a highlight costs no more than this, in roots over that of the pixel's bright level.
constexpr float kJuryTruncation = 0.16f;
// What is left after holding out has to span space well.
constexpr double kWorstSplitCondition = 30;
constexpr int kJuryBallSize = 64;
constexpr int kJuryRounds = 2;
constexpr size_t kJuryPerTask = 256;

// Of the Lambertian methods the simplest wins a tie; the exemplars win one against them, since they know what Lambert
// knows and highlights, too.
constexpr NormalMethod kCandidates[] = {NormalMethod::leastSquares, NormalMethod::threshold, NormalMethod::consensus,
                                        NormalMethod::exemplar};

bool isBetter(NormalMethod method, double error, double bestError)
{
    return method == NormalMethod::exemplar ? error <= (1 + kTieShare) * bestError + kTieDifference
                                            : error < (1 - kTieShare) * bestError - kTieDifference;
}

struct LightSplit {
    std::vector<size_t> kept, heldOut; // indices of lights
    std::vector<Light> keptLights, heldOutLights;
};

LightSplit splitLights(const std::vector<Light>& lights)
{
    LightSplit split;
    for (size_t i = 0; i < lights.size(); ++i) {
        const bool isHeldOut = i % kHeldOutEvery == kFirstHeldOut;
        (isHeldOut ? split.heldOut : split.kept).push_back(i);
        (isHeldOut ? split.heldOutLights : split.keptLights).push_back(lights[i]);
    }
    return split;
}

// What the jury sees: the sample under the lights that are kept, and under those that are not.
struct Jury {
    LightSplit split;
    PixelLattice kept;
    Intensities heldOut;
    BallGrid keptGrid, heldOutGrid;
};

Jury makeJury(const Intensities& sample, const LightSplit& split, int threads)
{
    Jury jury{split, makePixelLattice(selectLights(sample, split.kept), threads), selectLights(sample, split.heldOut),
              makeBallGrid(kJuryBallSize, split.keptLights, threads),
              makeBallGrid(kJuryBallSize, split.heldOutLights, threads)};
    // The lobes' bins of both are the same, since the lights that are kept say what was measured.
    jury.heldOutGrid.largestThetaD = jury.keptGrid.largestThetaD;
    return jury;
}

// The object's own reflectance, of the form asked for, as it follows from normals under the lights that are kept.
void measureReflectance(const Jury& jury, bool additive, int threads, MatchModel& model,
                        std::vector<BallMatch>& matches)
{
    model.ball = makeReflectanceBall(jury.keptGrid, model.reflectance, threads);
    for (int round = 0; round <= kJuryRounds; ++round) {
        parallelFor(matches.size(), kJuryPerTask, threads, [&](size_t first, size_t last) {
            for (size_t p = first; p < last; ++p) {
                matches[p] = matchAtTexel(model, jury.kept, p, matches[p].texel, matches[p].scale);
            }
        });
        if (round < kJuryRounds) {
            fitReflectance(jury.kept, additive, model, matches);
            model.ball = makeReflectanceBall(jury.keptGrid, model.reflectance, threads);
        }
    }
}

// The mean error of what a model predicts of the lights that were held out: |sqrt(observed) - sqrt(predicted)| over the
// root of the pixel's bright level, truncated at kJuryTruncation and in units of it.
double predictionError(const Jury& jury, MatchModel model, const std::vector<BallMatch>& matches, int threads)
{
    model.ball = makeReflectanceBall(jury.heldOutGrid, model.reflectance, threads);
    double sum = 0;
    std::vector<float> predicted(jury.heldOut.lightCount);
    for (size_t p = 0; p < matches.size(); ++p) {
        const float bright = jury.kept.bright[p];
        predictMatch(model, matches[p], bright, predicted.data());
        for (size_t i = 0; i < predicted.size(); ++i) {
            const float observed = std::sqrt(std::max(jury.heldOut.ofPixel(p)[i] / bright, 0.0f));
            sum += std::min(std::abs(observed - std::sqrt(predicted[i] / bright)) / kJuryTruncation, 1.0f);
        }
    }
    return sum / static_cast<double>(matches.size() * predicted.size());
}

// Of normals alone: the reflectance that follows from them, of both forms that it may have the better one.
double predictionError(const Jury& jury, const std::vector<PixelNormal>& normals, int threads)
{
    double least = std::numeric_limits<double>::max();
    for (const bool additive : {false, true}) {
        std::vector<BallMatch> matches;
        for (const PixelNormal& pixel : normals) {
            matches.push_back(
                {ballTexelOf(pixel.albedo > 0 ? pixel.normal : glm::vec3(0, 0, 1), kJuryBallSize), 1, 2, -1});
        }
        MatchModel model;
        measureReflectance(jury, additive, threads, model, matches);
        least = std::min(least, predictionError(jury, std::move(model), matches, threads));
    }
    return least;
}

NormalEstimator makeEstimator(NormalMethod method, const Intensities& sample, const std::vector<Light>& lights,
                              const NormalOptions& options, std::vector<Finding>& findings)
{
    switch (method) {
    case NormalMethod::leastSquares:
        return makeLeastSquaresEstimator(lights, options);
    case NormalMethod::threshold:
        return makeThresholdEstimator(lights, options);
    case NormalMethod::twoStep:
        return makeTwoStepEstimator(lights, options);
    case NormalMethod::ransac:
        return makeRansacEstimator(lights, options);
    case NormalMethod::exemplar:
        return makeExemplarEstimator(sample, lights, options, findings);
    case NormalMethod::automatic:
    case NormalMethod::consensus:
        break;
    }
    return makeConsensusEstimator(lights, options);
}

double heldOutError(NormalMethod method, const Jury& jury, const NormalOptions& options)
{
    std::vector<Finding> unused;
    const Intensities& kept = jury.kept.intensities;
    if (method == NormalMethod::exemplar) {
        ExemplarModel model = makeExemplarModel(kept, jury.split.keptLights, options, unused);
        const std::vector<BallMatch> matches = matchPixels(model, jury.kept, options.threads);
        return predictionError(jury, std::move(model.match), matches, options.threads);
    }
    const NormalEstimator estimator = makeEstimator(method, kept, jury.split.keptLights, options, unused);
    return predictionError(jury, estimator(kept).pixels, options.threads);
}

// The method whose normals let the object's own reflectance predict held-out lights best: every sixth light is left
// out, and each candidate estimates the sample's normals from the others. A tie goes to the simplest Lambertian method,
// and to the exemplars before any of those.
NormalMethod selectNormalMethod(const Intensities& sample, const std::vector<Light>& lights,
                                const NormalOptions& options, std::vector<Finding>& findings)
{
    const LightSplit split = splitLights(lights);
    const bool few = lights.size() < kFewestToHoldOut;
    if (few || conditionOf(split.keptLights) > kWorstSplitCondition || sample.pixelCount() == 0) {
        findings.push_back(
            {FindingCode::methodChosen,
             few ? fmt::format("auto: consensus, since {} lights are too few to hold any out", lights.size())
                 : "auto: consensus, since the lights lie too nearly in one plane to hold any out"});
        return NormalMethod::consensus;
    }
    const Jury jury = makeJury(sample, split, options.threads);
    NormalMethod best = kCandidates[0];
    double bestError = 0;
    std::string errors;
    for (const NormalMethod method : kCandidates) {
        const double error = heldOutError(method, jury, options);
        errors += fmt::format("{}{} {:.4f}", errors.empty() ? "" : ", ", nameOf(method), error);
        if (method == kCandidates[0] || isBetter(method, error, bestError)) {
            best = method;
            bestError = error;
        }
    }
    findings.push_back({FindingCode::methodChosen, fmt::format("auto: {}, by the error on {} held-out lights: {}",
                                                               nameOf(best), split.heldOut.size(), errors)});
    if (bestError > kUnexplained) {
        findings.push_back(
            {FindingCode::noMethod,
             "no method explains this object (a mirror? wrong lights?); the normals are not to be trusted"});
        best = NormalMethod::exemplar;
    }
    return best;
}

} // namespace

NormalEstimator makeNormalEstimator(const Intensities& sample, const std::vector<Light>& lights,
                                    const NormalOptions& options, NormalReport& report)
{
    report.method = options.method == NormalMethod::automatic
                        ? selectNormalMethod(sample, lights, options, report.findings)
                        : options.method;
    return makeEstimator(report.method, sample, lights, options, report.findings);
}

} // namespace nacre
