#include <algorithm>
#include <memory>

#include "acquisition/normals/lambertian_solver.h"

namespace nacre {

namespace {

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
    std::vector<float> sorted(observed.begin(), observed.end());
    std::sort(sorted.begin(), sorted.end());
    const size_t n = sorted.size();
    const size_t dark = static_cast<size_t>(options.darkestShare * n);
    const size_t bright = std::min(static_cast<size_t>(options.brightestShare * n), n - dark - 1);
    keepBetween(observed, sorted[dark], sorted[n - 1 - bright], weights);
}

} // namespace

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

} // namespace nacre
