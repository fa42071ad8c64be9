#include <algorithm>
#include <cmath>
#include <memory>

#include <glm/geometric.hpp>

#include "acquisition/normals/lambertian_solver.h"
#include "acquisition/normals/light_triples.h"
#include "engine/files/measures.h"

namespace nacre {

namespace {

// The paper's "given range" of the diffuse factor: this share around the median of all triples of the pixel.
constexpr float kDiffuseRange = 0.25f;
// An observation stays if at least this share of its triples is valid, relative to its best supported peer.
constexpr float kSupportShare = 0.5f;
// Second step: further from the line than so many robust standard deviations is out.
constexpr float kOutlierSigmas = 2.5f;

struct TwoStepSetup {
    std::vector<glm::vec3> directions;
    std::vector<LightTriple> triples;
    LambertianSolver solver;
    int threads;
};

// First step: weights 1 for observations that are in enough triples with a plausible diffuse factor.
std::vector<float> plausibleObservations(const TwoStepSetup& setup, std::span<const float> observed)
{
    std::vector<float> factors;
    for (const LightTriple& t : setup.triples) {
        factors.push_back(glm::length(t.inverse * glm::vec3(observed[t.a], observed[t.b], observed[t.c])));
    }
    std::vector<float> sorted = factors;
    const float median = sorted.empty() ? 0.0f : quantile(sorted, 0.5);
    std::vector<float> valid(observed.size(), 0.0f), all(observed.size(), 0.0f);
    for (size_t j = 0; j < factors.size(); ++j) {
        const bool plausible = std::abs(factors[j] - median) <= kDiffuseRange * median;
        for (const int i : {setup.triples[j].a, setup.triples[j].b, setup.triples[j].c}) {
            valid[i] += plausible;
            all[i] += 1;
        }
    }
    float best = 0;
    for (size_t i = 0; i < valid.size(); ++i) {
        valid[i] = all[i] > 0 ? valid[i] / all[i] : 0.0f;
        best = std::max(best, valid[i]);
    }
    for (float& share : valid) {
        share = share > 0 && share >= kSupportShare * best ? 1.0f : 0.0f;
    }
    return valid;
}

// Second step: drops what is far from the line that the first step's observations gave.
void dropFarObservations(const TwoStepSetup& setup, std::span<const float> observed, const PixelNormal& pixel,
                         std::vector<float>& weights)
{
    std::vector<float> distances;
    const auto distance = [&](size_t i) {
        return std::abs(observed[i] - pixel.albedo * glm::dot(pixel.normal, setup.directions[i]));
    };
    for (size_t i = 0; i < observed.size(); ++i) {
        if (weights[i] > 0) {
            distances.push_back(distance(i));
        }
    }
    const float limit = distances.empty() ? 0.0f : kOutlierSigmas * 1.4826f * quantile(distances, 0.5);
    for (size_t i = 0; i < observed.size(); ++i) {
        weights[i] *= distance(i) <= limit ? 1.0f : 0.0f;
    }
}

} // namespace

// Wu et al., section 4.2, two-steps outlier removal.
NormalEstimator makeTwoStepEstimator(const std::vector<Light>& lights, const NormalOptions& options)
{
    const auto setup = std::make_shared<TwoStepSetup>(
        TwoStepSetup{directionsOf(lights), makeLightTriples(lights, options.triples, options.seed),
                     LambertianSolver(lights), options.threads});
    return [setup](const Intensities& intensities) {
        return solveBlock(intensities, setup->solver, setup->threads, [&](size_t, std::span<const float> observed) {
            std::vector<float> weights = plausibleObservations(*setup, observed);
            const PixelNormal first = setup->solver.solve(observed, weights);
            if (first.albedo <= 0) {
                return first;
            }
            dropFarObservations(*setup, observed, first, weights);
            const PixelNormal second = setup->solver.solve(observed, weights);
            return second.albedo > 0 ? second : first;
        });
    };
}

} // namespace nacre
