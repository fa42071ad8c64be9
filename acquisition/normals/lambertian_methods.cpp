#include <algorithm>
#include <cmath>
#include <iterator>

#include <glm/geometric.hpp>

#include "acquisition/normals/lambertian_solver.h"
#include "acquisition/normals/light_triples.h"
#include "engine/files/measures.h"

namespace nacre {

namespace {

// What methods that try triples of lights have in common, made once per set of lights.
struct TripleSetup {
    std::vector<glm::vec3> directions;
    std::vector<LightTriple> triples;
    LambertianSolver solver;
    int threads;
};

std::shared_ptr<const TripleSetup> makeTripleSetup(const std::vector<Light>& lights, const NormalOptions& options)
{
    return std::make_shared<const TripleSetup>(TripleSetup{directionsOf(lights),
                                                           makeLightTriples(lights, options.triples, options.seed),
                                                           LambertianSolver(lights), options.threads});
}

void keepBetween(std::span<const float> observed, float low, float high, std::vector<float>& weights)
{
    for (size_t i = 0; i < observed.size(); ++i) {
        weights[i] = observed[i] >= low && observed[i] <= high && observed[i] > 0 ? 1.0f : 0.0f;
    }
}

// The paper's manual thresholds (section 4.2), or shares of the pixel's own sorted observations.
void keepByThreshold(std::span<const float> observed, const NormalOptions& options, std::vector<float>& weights)
{
    if (options.lowThreshold >= 0 && options.highThreshold > options.lowThreshold) {
        keepBetween(observed, options.lowThreshold, options.highThreshold, weights);
        return;
    }
    std::vector<float> sorted;
    std::copy_if(observed.begin(), observed.end(), std::back_inserter(sorted), [](float v) { return !isClipped(v); });
    if (sorted.empty()) {
        return;
    }
    std::sort(sorted.begin(), sorted.end());
    const size_t n = sorted.size();
    const size_t dark = static_cast<size_t>(options.darkestShare * n);
    const size_t bright = std::min(static_cast<size_t>(options.brightestShare * n), n - dark - 1);
    keepBetween(observed, sorted[dark], sorted[n - 1 - bright], weights);
}

} // namespace

// All observations alike: attached shadows and highlights are taken for data.
NormalEstimator makeLeastSquaresEstimator(const std::vector<Light>& lights, const NormalOptions& options)
{
    const auto solver = std::make_shared<LambertianSolver>(lights);
    return [solver, options](const Intensities& intensities) {
        return solveBlock(intensities, *solver, options.threads,
                          [&](size_t, std::span<const float> observed) { return solver->solve(observed); });
    };
}

NormalEstimator makeThresholdEstimator(const std::vector<Light>& lights, const NormalOptions& options)
{
    const auto solver = std::make_shared<LambertianSolver>(lights);
    return [solver, options](const Intensities& intensities) {
        return solveBlock(intensities, *solver, options.threads, [&](size_t, std::span<const float> observed) {
            std::vector<float> weights(observed.size());
            keepByThreshold(observed, options, weights);
            return solver->solve(observed, weights);
        });
    };
}

namespace {

// The paper's "given range" of the diffuse factor: this share around the median of all triples of the pixel.
constexpr float kDiffuseRange = 0.25f;
// An observation stays if at least this share of its triples is valid, relative to its best supported peer.
constexpr float kSupportShare = 0.5f;
// Second step: further from the line than so many robust standard deviations is out.
constexpr float kOutlierSigmas = 2.5f;

// First step: weights 1 for observations that are in enough triples with a plausible diffuse factor.
std::vector<float> plausibleObservations(const TripleSetup& setup, std::span<const float> observed)
{
    std::vector<float> factors;
    for (const LightTriple& t : setup.triples) {
        factors.push_back(glm::length(t.inverse * glm::vec3(observed[t.a], observed[t.b], observed[t.c])));
    }
    std::vector<float> sorted;
    std::copy_if(factors.begin(), factors.end(), std::back_inserter(sorted), [](float v) { return !isClipped(v); });
    const float median = sorted.empty() ? 0.0f : quantile(sorted, 0.5);
    std::vector<float> valid(observed.size(), 0.0f), all(observed.size(), 0.0f);
    for (size_t j = 0; j < factors.size(); ++j) {
        const bool plausible = std::abs(factors[j] - median) <= kDiffuseRange * median;
        for (const int i : {setup.triples[j].a, setup.triples[j].b, setup.triples[j].c}) {
            valid[i] += plausible;
            all[i] += !isClipped(factors[j]);
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
void dropFarObservations(const TripleSetup& setup, std::span<const float> observed, const PixelNormal& pixel,
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
    const auto setup = makeTripleSetup(lights, options);
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

namespace {

// Step 2's "small enough error": this share of the pixel's bright level.
constexpr float kInlierShare = 0.05f;

} // namespace

// Wu et al., section 4.2: of all triples the one with the least sum of distances, the observations near its line, and
// least squares on them. Fischler and Bolles, Random Sample Consensus, 1981, with all triples in place of random ones.
NormalEstimator makeRansacEstimator(const std::vector<Light>& lights, const NormalOptions& options)
{
    const auto setup = makeTripleSetup(lights, options);
    return [setup](const Intensities& intensities) {
        const std::vector<glm::vec3> lines = findBestTriples(intensities, setup->triples, setup->directions,
                                                             TripleCost::sumOfDistances, 0, setup->threads);
        return solveBlock(intensities, setup->solver, setup->threads, [&](size_t p, std::span<const float> observed) {
            const float limit = kInlierShare * brightLevel(observed);
            std::vector<float> weights(observed.size());
            for (size_t i = 0; i < observed.size(); ++i) {
                weights[i] = std::abs(observed[i] - glm::dot(lines[p], setup->directions[i])) <= limit ? 1.0f : 0.0f;
            }
            return setup->solver.solve(observed, weights);
        });
    };
}

namespace {

// A residual beyond this share of the pixel's 90th percentile costs no more: highlights and shadows are as bad as can
// be.
constexpr float kTruncationShare = 0.08f;
// Tukey's biweight of the refit: cut at so many robust standard deviations, at least this share of the albedo, within
// which photographs and lights are not known better.
constexpr float kCutSigmas = 2.0f;
constexpr float kLeastCutShare = 0.05f;
constexpr int kRefits = 5;

// Iteratively reweighted least squares over the lights that the current normal faces.
PixelNormal refit(const TripleSetup& setup, std::span<const float> observed, glm::vec3 g)
{
    std::vector<float> weights(observed.size()), predicted(observed.size()), residuals;
    PixelNormal pixel;
    for (int step = 0; step < kRefits; ++step) {
        setup.solver.project(g, predicted);
        residuals.resize(observed.size());
        size_t count = 0; // without a branch, which would be guessed wrong every third time
        for (size_t i = 0; i < observed.size(); ++i) {
            residuals[count] = std::abs(observed[i] - predicted[i]);
            count += static_cast<size_t>(predicted[i] > 0) & static_cast<size_t>(!isClipped(observed[i]));
        }
        residuals.resize(count);
        if (residuals.size() < 3) {
            break;
        }
        const float cut = std::max(kCutSigmas * 1.4826f * quantile(residuals, 0.5), kLeastCutShare * glm::length(g));
        for (size_t i = 0; i < observed.size(); ++i) {
            const float u = (observed[i] - predicted[i]) / cut, share = std::max(0.0f, 1 - u * u); // clipped: 0
            weights[i] = predicted[i] > 0 ? share * share : 0.0f;
        }
        const PixelNormal next = setup.solver.solve(observed, weights);
        if (next.albedo <= 0) {
            break;
        }
        pixel = next;
        g = pixel.albedo * pixel.normal;
    }
    return pixel;
}

} // namespace

// The triple whose line explains most of the pixel's observations, attached shadows included, then a robust refit.
NormalEstimator makeConsensusEstimator(const std::vector<Light>& lights, const NormalOptions& options)
{
    const auto setup = makeTripleSetup(lights, options);
    return [setup](const Intensities& intensities) {
        const std::vector<glm::vec3> starts = findBestTriples(intensities, setup->triples, setup->directions,
                                                              TripleCost::truncated, kTruncationShare, setup->threads);
        return solveBlock(intensities, setup->solver, setup->threads, [&](size_t p, std::span<const float> observed) {
            return refit(*setup, observed, starts[p]);
        });
    };
}

} // namespace nacre
