#include "evaluation/stress/stress_brdf.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "acquisition/brdf/albedo_factor.h"
#include "acquisition/brdf/bake.h"
#include "acquisition/brdf/brdf_samples.h"

namespace nacre {

namespace {

const glm::vec3 kView(0, 0, 1);
constexpr size_t kMostJudged = 1000; // pixels
constexpr float kLeastCosine = 0.1f; // as samples are taken
// Below this share of the pixel's bright level an observation is in a cast shadow, of which no BRDF knows.
constexpr float kLitShare = 0.25f;

BrdfTable bakedTable(const StressPhotographs& photographs, const NormalBlock& normals, const AcquireOptions& options)
{
    const std::vector<Light>& lights = photographs.reconciled.sample.lights;
    BrdfSamples samples;
    samples.domain = tableDomain(lights, options.bake);
    SampleCounts counts;
    gatherSamples(photographs.seen, normals, albedoFactors(photographs.seen, normals, lights), lights, 1,
                  options.samples, samples, counts);
    return bakeBrdf(samples, options.interpolation, options.bake).table;
}

struct ErrorSums {
    double missed = 0, seen = 0, confidence = 0, count = 0;
};

void addPixel(const BrdfTable& table, const glm::vec3& normal, std::span<const glm::vec3> radiance,
              const std::vector<Light>& lights, ErrorSums& sums)
{
    std::vector<float> observed, predicted;
    for (size_t i = 0; i < lights.size(); ++i) {
        const float nDotL = glm::dot(normal, lights[i].direction);
        const BrdfValue f = evaluateTable(table, normal, lights[i].direction, kView);
        const bool faces = nDotL > kLeastCosine;
        observed.push_back(greyOf(radiance[i] / lights[i].irradiance));
        predicted.push_back(faces ? nDotL * greyOf(f.value) : 0.0f);
        sums.confidence += faces ? f.confidence : 0.0f;
        sums.count += faces;
    }
    const float lit = kLitShare * brightLevel(observed);
    double products = 0, squares = 0;
    for (size_t i = 0; i < lights.size(); ++i) {
        predicted[i] = observed[i] > lit ? predicted[i] : 0.0f;
        products += predicted[i] * observed[i];
        squares += predicted[i] * predicted[i];
    }
    for (size_t i = 0; i < lights.size() && squares > 0; ++i) {
        if (predicted[i] > 0) {
            sums.missed += std::abs(products / squares * predicted[i] - observed[i]);
            sums.seen += observed[i];
        }
    }
}

} // namespace

BrdfError brdfError(const StressPhotographs& photographs, const NormalBlock& normals,
                    const PhotographedObject& undegraded, const AcquireOptions& options)
{
    const BrdfTable table = bakedTable(photographs, normals, options);
    ErrorSums sums;
    const size_t pixels = undegraded.seen.pixels.size(), step = pixels / kMostJudged + 1;
    for (size_t p = 0; p < pixels; p += step) {
        if (undegraded.truth.confidence[p] > 0) {
            addPixel(table, undegraded.truth.normals[p], undegraded.seen.radianceOf(p), undegraded.lights, sums);
        }
    }
    return {100 * sums.missed / std::max(sums.seen, 1e-30), sums.confidence / std::max(1.0, sums.count)};
}

} // namespace nacre
