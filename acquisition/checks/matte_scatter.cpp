#include "acquisition/checks/matte_scatter.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace nacre {

namespace {

// Shares of the pixel's bright level. Less than the first of a prediction is grazing light, less than the second of an
// observation a cast shadow.
constexpr float kLeastPredicted = 0.2f;
constexpr float kLeastObserved = 0.1f;
constexpr double kMatteShare = 0.6;
// An observation that a fit does not light at all misses by as much as can be missed.
constexpr float kMostMissed = 1;

float predicted(const PixelNormal& pixel, const Light& light)
{
    return pixel.albedo * glm::dot(pixel.normal, light.direction);
}

} // namespace

MatteChoice matteObservations(const Intensities& intensities, const NormalBlock& fit, const std::vector<Light>& lights)
{
    const size_t n = lights.size();
    MatteChoice choice{std::vector<char>(intensities.pixelCount() * n, 0)};
    for (size_t p = 0; p < intensities.pixelCount(); ++p) {
        const auto observed = intensities.ofPixel(p);
        const float level = brightLevel(observed);
        for (size_t i = 0; i < n; ++i) {
            choice.counts[p * n + i] = observed[i] > kLeastObserved * level && level > 0 &&
                                       predicted(fit.pixels[p], lights[i]) > kLeastPredicted * level;
        }
    }
    return choice;
}

double matteScatter(const Intensities& intensities, const NormalBlock& fit, const std::vector<Light>& lights,
                    const MatteChoice& choice)
{
    const size_t n = lights.size();
    std::vector<float> missed;
    for (size_t p = 0; p < intensities.pixelCount(); ++p) {
        const auto observed = intensities.ofPixel(p);
        for (size_t i = 0; i < n; ++i) {
            if (choice.counts[p * n + i]) {
                const float ratio = observed[i] / predicted(fit.pixels[p], lights[i]);
                missed.push_back(ratio > 0 ? std::min(std::abs(std::log(ratio)), kMostMissed) : kMostMissed);
            }
        }
    }
    std::sort(missed.begin(), missed.end());
    missed.resize(static_cast<size_t>(kMatteShare * static_cast<double>(missed.size())));
    double sum = 0;
    for (const float m : missed) {
        sum += m;
    }
    return missed.empty() ? 0 : sum / static_cast<double>(missed.size());
}

} // namespace nacre
