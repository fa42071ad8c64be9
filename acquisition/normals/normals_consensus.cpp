#include <algorithm>
#include <cmath>
#include <memory>

#include <glm/geometric.hpp>

#include "acquisition/normals/lambertian_solver.h"
#include "acquisition/normals/triple_search.h"
#include "engine/files/measures.h"

namespace nacre {

namespace {

// A residual beyond this share of the pixel's 90th percentile costs no more: highlights and shadows are as bad as can
// be.
constexpr float kTruncationShare = 0.08f;
// Tukey's biweight of the refit: cut at so many robust standard deviations, at least this share of the albedo, within
// which photographs and lights are not known better.
constexpr float kCutSigmas = 2.0f;
constexpr float kLeastCutShare = 0.05f;
constexpr int kRefits = 5;

struct ConsensusSetup {
    std::vector<glm::vec3> directions;
    std::vector<LightTriple> triples;
    LambertianSolver solver;
    int threads;
};

// Iteratively reweighted least squares over the lights that the current normal faces.
PixelNormal refit(const ConsensusSetup& setup, std::span<const float> observed, glm::vec3 g)
{
    std::vector<float> weights(observed.size()), residuals;
    PixelNormal pixel;
    for (int step = 0; step < kRefits; ++step) {
        residuals.clear();
        for (size_t i = 0; i < observed.size(); ++i) {
            const float predicted = glm::dot(g, setup.directions[i]);
            if (predicted > 0) {
                residuals.push_back(std::abs(observed[i] - predicted));
            }
        }
        if (residuals.size() < 3) {
            break;
        }
        const float cut = std::max(kCutSigmas * 1.4826f * quantile(residuals, 0.5), kLeastCutShare * glm::length(g));
        for (size_t i = 0; i < observed.size(); ++i) {
            const float predicted = glm::dot(g, setup.directions[i]), u = (observed[i] - predicted) / cut;
            weights[i] = predicted > 0 && std::abs(u) < 1 ? (1 - u * u) * (1 - u * u) : 0.0f;
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
    const auto setup = std::make_shared<ConsensusSetup>(
        ConsensusSetup{directionsOf(lights), makeLightTriples(lights, options.triples, options.seed),
                       LambertianSolver(lights), options.threads});
    return [setup](const Intensities& intensities) {
        const std::vector<glm::vec3> starts = findBestTriples(intensities, setup->triples, setup->directions,
                                                              TripleCost::truncated, kTruncationShare, setup->threads);
        return solveBlock(intensities, setup->solver, setup->threads, [&](size_t p, std::span<const float> observed) {
            return refit(*setup, observed, starts[p]);
        });
    };
}

} // namespace nacre
