#include "acquisition/exemplar/object_exemplar.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "acquisition/brdf/bake.h"
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

} // namespace nacre
