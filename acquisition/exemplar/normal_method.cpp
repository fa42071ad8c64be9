#include "acquisition/exemplar/normal_method.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "acquisition/exemplar/exemplar_model.h"
#include "acquisition/lights/lights.h"

namespace nacre {

namespace {

constexpr size_t kMostSelectionPixels = 1500;
constexpr size_t kFewestToHoldOut = 9;
// Errors this close are a tie: 2 %, and what the table's own grain makes, in units of the truncation limit.
constexpr double kTieShare = 0.02;
constexpr double kTieDifference = 0.002;
// Beyond it more than half of what is predicted is as wrong as counts: the errors no longer tell methods apart.
constexpr double kUnexplained = 0.5;
// A cast shadow or a highlight costs no more than this share of the pixel's bright level.
constexpr float kSelectionLimitShare = 0.5f;
// What is left after holding out has to span space well.
constexpr double kWorstSplitCondition = 30;

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
    std::vector<Light> keptLights;
};

LightSplit splitLights(const std::vector<Light>& lights)
{
    LightSplit split;
    for (size_t i = 0; i < lights.size(); ++i) {
        (isHeldOut(i) ? split.heldOut : split.kept).push_back(i);
    }
    for (const size_t i : split.kept) {
        split.keptLights.push_back(lights[i]);
    }
    return split;
}

std::vector<float> weightsOf(const std::vector<size_t>& chosen, size_t lights)
{
    std::vector<float> weights((lights + 7) / 8 * 8, 0.0f);
    for (const size_t i : chosen) {
        weights[i] = 1;
    }
    return weights;
}

// The mean square of what the predictions miss, each truncated at kSelectionLimitShare of the pixel's bright level and
// in units of it: [0,1].
double squaredCost(const std::vector<float>& column, std::span<const float> observed, const std::vector<float>& judged,
                   float scale)
{
    const float limit = std::max(kSelectionLimitShare * brightLevel(observed), std::numeric_limits<float>::min());
    double sum = 0, count = 0;
    for (size_t i = 0; i < observed.size(); ++i) {
        const float residual = std::min(std::abs(observed[i] - scale * column[i]) / limit, 1.0f);
        sum += judged[i] * residual * residual;
        count += judged[i];
    }
    return sum / count;
}

// The truncated error (root mean square) of the table's predictions under the held-out lights; each pixel's albedo is
// that of the lights that were kept.
double predictionError(const BrdfTable& table, const Intensities& sample, const std::vector<Light>& lights,
                       const std::vector<glm::vec3>& normals, const std::vector<float>& kept,
                       const std::vector<float>& heldOut)
{
    double sum = 0;
    std::vector<float> column(sample.stride, 0.0f);
    for (size_t p = 0; p < sample.pixelCount(); ++p) {
        for (size_t i = 0; i < lights.size(); ++i) {
            const float nDotL = glm::dot(normals[p], lights[i].direction);
            column[i] =
                nDotL > 0 ? evaluateTable(table, normals[p], lights[i].direction, {0, 0, 1}).value.x * nDotL : 0.0f;
        }
        const float scale = fittedScale(column.data(), sample.stride, targetOf(sample, p, kept), kOwnScales);
        sum += squaredCost(column, sample.ofPixel(p), heldOut, scale);
    }
    return std::sqrt(sum / static_cast<double>(sample.pixelCount()));
}

// The held-out error of the BRDF that a method's normals give; 1 where they give none.
double heldOutError(NormalMethod method, const Intensities& sample, const std::vector<Light>& lights,
                    const LightSplit& split, const NormalOptions& options)
{
    NormalOptions chosen = options;
    chosen.method = method;
    NormalReport unused;
    const Intensities kept = selectLights(sample, split.kept);
    const NormalBlock block = makeNormalEstimator(kept, split.keptLights, chosen, unused)(kept);
    ExemplarResult result;
    for (const PixelNormal& pixel : block.pixels) {
        const bool found = pixel.albedo > 0;
        result.normals.push_back(found ? pixel.normal : glm::vec3(0, 0, 1));
        result.scales.push_back(found ? pixel.albedo : 0.0f);
    }
    std::vector<Verdict> verdicts(sample.pixelCount() * lights.size(), Verdict::shadow);
    for (size_t p = 0; p < sample.pixelCount(); ++p) {
        for (size_t i = 0; i < split.kept.size(); ++i) {
            verdicts[p * lights.size() + split.kept[i]] = block.verdicts[p * split.kept.size() + i];
        }
    }
    const std::vector<float> keptWeights = weightsOf(split.kept, lights.size()),
                             heldOutWeights = weightsOf(split.heldOut, lights.size());
    const std::optional<BrdfTable> own =
        makeObjectTable(sample, result, verdicts, lights, keptWeights, options.threads);
    return own ? predictionError(*own, sample, lights, result.normals, keptWeights, heldOutWeights) : 1.0;
}

// The method whose normals let the object's own BRDF predict held-out lights best: every sixth light is left out, each
// candidate estimates the sample's normals from the others, the BRDF is baked from its lit observations, and the
// truncated error of its predictions counts. A tie goes to the simplest Lambertian method, and to the exemplars before
// any of those.
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
    const Intensities thinned = selectPixels(sample, spreadPixels(sample.pixelCount(), kMostSelectionPixels));
    NormalMethod best = kCandidates[0];
    double bestError = 0;
    std::string errors;
    for (const NormalMethod method : kCandidates) {
        const double error = heldOutError(method, thinned, lights, split, options);
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
    switch (report.method) {
    case NormalMethod::leastSquares:
        return makeLeastSquaresEstimator(lights, options);
    case NormalMethod::threshold:
        return makeThresholdEstimator(lights, options);
    case NormalMethod::twoStep:
        return makeTwoStepEstimator(lights, options);
    case NormalMethod::ransac:
        return makeRansacEstimator(lights, options);
    case NormalMethod::exemplar:
        return makeExemplarEstimator(sample, lights, options, report.findings);
    case NormalMethod::automatic:
    case NormalMethod::consensus:
        break;
    }
    return makeConsensusEstimator(lights, options);
}

} // namespace nacre
