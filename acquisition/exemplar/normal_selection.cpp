#include "acquisition/exemplar/normal_selection.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "acquisition/exemplar/normal_method.h"
#include "acquisition/exemplar/object_exemplar.h"
#include "acquisition/lights/lights.h"

namespace nacre {

namespace {

constexpr size_t kMostPixels = 1500;
constexpr size_t kFewestLights = 9;
// Errors this close are a tie: 2 %, and what the table's own grain makes, in units of the truncation limit.
constexpr double kTieShare = 0.02;
constexpr double kTieDifference = 0.002;
// Beyond it more than half of what is predicted is as wrong as counts: the errors no longer tell methods apart.
constexpr double kUnexplained = 0.5;
// A cast shadow or a highlight costs no more than this share of the pixel's bright level.
constexpr float kSelectionLimitShare = 0.5f;
// What is left after holding out has to span space well.
constexpr double kWorstCondition = 30;

// Of the Lambertian methods the simplest wins a tie; the exemplars win one against them, since they know what Lambert
// knows and highlights, too.
constexpr NormalMethod kCandidates[] = {NormalMethod::leastSquares, NormalMethod::threshold, NormalMethod::consensus,
                                        NormalMethod::exemplar};

bool isBetter(NormalMethod method, double error, double bestError)
{
    return method == NormalMethod::exemplar ? error <= (1 + kTieShare) * bestError + kTieDifference
                                            : error < (1 - kTieShare) * bestError - kTieDifference;
}

struct Split {
    std::vector<size_t> kept, heldOut; // indices of lights
    std::vector<Light> keptLights;
};

Split splitLights(const std::vector<Light>& lights)
{
    Split split;
    for (size_t i = 0; i < lights.size(); ++i) {
        (isHeldOut(i) ? split.heldOut : split.kept).push_back(i);
    }
    for (const size_t i : split.kept) {
        split.keptLights.push_back(lights[i]);
    }
    return split;
}

Intensities everyNthPixel(const Intensities& sample)
{
    const size_t count = std::min(kMostPixels, sample.pixelCount());
    Intensities few = makeIntensities(count, sample.lightCount);
    for (size_t j = 0; j < count; ++j) {
        std::copy_n(sample.padded((2 * j + 1) * sample.pixelCount() / (2 * count)), sample.stride,
                    &few.values[j * few.stride]);
    }
    return few;
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
                    const Split& split, const NormalOptions& options)
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

} // namespace

NormalMethod selectNormalMethod(const Intensities& sample, const std::vector<Light>& lights,
                                const NormalOptions& options, std::vector<Finding>& findings)
{
    const Split split = splitLights(lights);
    const bool few = lights.size() < kFewestLights;
    if (few || conditionOf(split.keptLights) > kWorstCondition || sample.pixelCount() == 0) {
        findings.push_back(
            {FindingCode::methodChosen,
             few ? fmt::format("auto: consensus, since {} lights are too few to hold any out", lights.size())
                 : "auto: consensus, since the lights lie too nearly in one plane to hold any out"});
        return NormalMethod::consensus;
    }
    const Intensities thinned = everyNthPixel(sample);
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

} // namespace nacre
