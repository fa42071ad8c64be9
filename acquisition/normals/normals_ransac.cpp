#include <cmath>
#include <memory>

#include <glm/geometric.hpp>

#include "acquisition/normals/lambertian_solver.h"
#include "acquisition/normals/triple_search.h"

namespace nacre {

namespace {

// Step 2's "small enough error": this share of the pixel's bright level.
constexpr float kInlierShare = 0.05f;

} // namespace

// Wu et al., section 4.2: of all triples the one with the least sum of distances, the observations near its line, and
// least squares on them. Fischler and Bolles, Random Sample Consensus, 1981, with all triples in place of random ones.
NormalEstimator makeRansacEstimator(const std::vector<Light>& lights, const NormalOptions& options)
{
    struct Setup {
        std::vector<glm::vec3> directions;
        std::vector<LightTriple> triples;
        LambertianSolver solver;
        int threads;
    };
    const auto setup =
        std::make_shared<Setup>(Setup{directionsOf(lights), makeLightTriples(lights, options.triples, options.seed),
                                      LambertianSolver(lights), options.threads});
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

} // namespace nacre
