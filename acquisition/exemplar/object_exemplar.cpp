#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "acquisition/brdf/bake.h"
#include "acquisition/exemplar/exemplar_model.h"
#include "acquisition/normals/light_triples.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

// Grazing light: f = I / (n.l) multiplies errors of the normal.
constexpr float kLeastObjectCosine = 0.15f;
constexpr size_t kMostSamples = 150000;
constexpr glm::ivec3 kTableSize{64, 0, 16}; // thetaD: one texel for two degrees

float medianScale(const ExemplarResult& result)
{
    std::vector<float> scales;
    std::copy_if(result.scales.begin(), result.scales.end(), std::back_inserter(scales), [](float s) { return s > 0; });
    return scales.empty() ? 1.0f : quantile(scales, 0.5);
}

BrdfSamples gatherObjectSamples(const Intensities& sample, const ExemplarResult& result,
                                const std::vector<Verdict>& verdicts, const std::vector<Light>& lights,
                                const std::vector<float>& weights)
{
    BrdfSamples samples;
    samples.domain = capturedDomain(lights, kHalfDifference);
    const float common = medianScale(result);
    const size_t wanted = countOf(weights) * sample.pixelCount();
    const size_t step = std::max<size_t>(1, (wanted + kMostSamples - 1) / kMostSamples);
    for (size_t p = 0; p < sample.pixelCount(); p += step) {
        const float albedo = result.scales[p] / common;
        for (size_t i = 0; i < lights.size(); ++i) {
            const float nDotL = glm::dot(result.normals[p], lights[i].direction);
            const bool lit = verdicts[p * lights.size() + i] != Verdict::shadow;
            if (weights[i] > 0 && lit && nDotL >= kLeastObjectCosine && albedo > 0) {
                samples.unit.push_back(
                    unitFromDirections(samples.domain, result.normals[p], lights[i].direction, {0, 0, 1}));
                samples.values.emplace_back(sample.ofPixel(p)[i] / (albedo * nDotL));
                samples.weights.push_back(nDotL);
            }
        }
    }
    return samples;
}

} // namespace

std::vector<float> allLights(size_t count)
{
    std::vector<float> weights((count + 7) / 8 * 8, 0.0f);
    std::fill_n(weights.begin(), count, 1.0f);
    return weights;
}

size_t countOf(const std::vector<float>& weights)
{
    return static_cast<size_t>(std::count_if(weights.begin(), weights.end(), [](float w) { return w > 0; }));
}

std::vector<Verdict> judgeByExemplar(const Exemplar& exemplar, const Intensities& intensities,
                                     const ExemplarResult& result, int threads)
{
    const size_t n = intensities.lightCount;
    std::vector<Verdict> verdicts(intensities.pixelCount() * n);
    parallelFor(intensities.pixelCount(), 512, threads, [&](size_t first, size_t last) {
        std::vector<float> predicted(exemplar.fine.stride);
        for (size_t p = first; p < last; ++p) {
            exemplar.fine.mixColumns(result.normals[p], predicted.data());
            std::transform(predicted.begin(), predicted.end(), predicted.begin(),
                           [&](float v) { return v * result.scales[p]; });
            judge(intensities.ofPixel(p), std::span(predicted).first(n), std::span(verdicts).subspan(p * n, n));
        }
    });
    return verdicts;
}

std::optional<BrdfTable> makeObjectTable(const Intensities& sample, const ExemplarResult& result,
                                         const std::vector<Verdict>& verdicts, const std::vector<Light>& lights,
                                         const std::vector<float>& weights, int threads)
{
    const BrdfSamples samples = gatherObjectSamples(sample, result, verdicts, lights, weights);
    if (samples.size() == 0) {
        return {};
    }
    BakeOptions options;
    options.size = kTableSize;
    options.size.y = std::max(3, static_cast<int>(samples.domain.thetaDMax * 180 / kPi / 2));
    options.threads = threads;
    return bakeBrdf(samples, InterpolationOptions{}, options).table;
}

Exemplar makeObjectExemplar(const BrdfTable& table, const std::vector<Light>& lights, int threads)
{
    const auto reflectance = [&](const glm::vec3& n, const glm::vec3& l) {
        return evaluateTable(table, n, l, {0, 0, 1}).value.x;
    };
    return {"the object's own BRDF",
            {},
            makePredictedBall(kFineBallSize, directionsOf(lights), reflectance, threads),
            kOwnScales};
}

namespace {

constexpr int kMostRounds = 3;
constexpr size_t kFewestKeptLights = 6;
// A round has to lower the held-out cost to this share of the round before.
constexpr double kLeastRoundGain = 0.98;
// Weights of the lights that are kept and of those held out; the padding is in neither.
void splitLights(size_t count, std::vector<float>& kept, std::vector<float>& heldOut)
{
    kept = heldOut = allLights(count);
    for (size_t i = 0; i < count; ++i) {
        (isHeldOut(i) ? kept : heldOut)[i] = 0;
    }
}

// False where no observation is left to bake the object's own BRDF from.
bool addRound(ExemplarModel& model, const Intensities& sample, const ExemplarResult& result,
              const std::vector<Light>& lights, const std::vector<float>& weights, int threads)
{
    const std::vector<Verdict> verdicts = judgeByExemplar(lastExemplar(model), sample, result, threads);
    const std::optional<BrdfTable> own = makeObjectTable(sample, result, verdicts, lights, weights, threads);
    if (own) {
        model.reestimated.push_back(makeObjectExemplar(*own, lights, threads));
    }
    return own.has_value();
}

} // namespace

void reestimate(ExemplarModel& model, const Intensities& sample, const std::vector<glm::vec3>& starts,
                const std::vector<Light>& lights, int threads, std::vector<Finding>& findings)
{
    std::vector<float> kept, heldOut;
    splitLights(lights.size(), kept, heldOut);
    if (countOf(kept) < kFewestKeptLights || countOf(heldOut) < 1) {
        return;
    }
    // How many rounds pay, found out without the held-out lights.
    ExemplarModel trial = model;
    ExemplarResult result = matchBlock(trial, sample, starts, kept, threads);
    double cost = predictionCost(lastExemplar(trial), sample, result, heldOut);
    const double first = cost;
    int rounds = 0;
    for (; rounds < kMostRounds; ++rounds) {
        if (!addRound(trial, sample, result, lights, kept, threads)) {
            break;
        }
        refineBlock(lastExemplar(trial), sample, kept, threads, result);
        const double next = predictionCost(lastExemplar(trial), sample, result, heldOut);
        if (!(next < kLeastRoundGain * cost)) {
            break;
        }
        cost = next;
    }
    if (rounds > 0) {
        findings.push_back(
            {FindingCode::reflectanceMeasured,
             fmt::format(
                 "re-estimated {} time(s) with the object's own BRDF: error on {} held-out lights {:.4f} -> {:.4f}",
                 rounds, countOf(heldOut), first, cost)});
    }
    // The same number of rounds with every light.
    const std::vector<float> all = allLights(lights.size());
    for (int round = 0; round < rounds; ++round) {
        if (round == 0) {
            result = matchBlock(model, sample, starts, all, threads);
        } else {
            refineBlock(lastExemplar(model), sample, all, threads, result);
        }
        addRound(model, sample, result, lights, all, threads);
    }
}

} // namespace nacre
