#include "acquisition/checks/lambertian_misfit.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "acquisition/normals/intensities.h"
#include "acquisition/normals/lambertian_solver.h"
#include "engine/files/measures.h"

namespace nacre {

namespace {

// Below this share of the pixel's 90th percentile an observation counts as in shadow; a pixel whose 90th percentile is
// below this share of the brightest tenth's counts as background, of which captures without a mask have much.
constexpr float kLitShare = 0.25f;
constexpr float kObjectShare = 0.1f;
// With three lights every pixel fits.
constexpr int kFewestLit = 4;

float objectLevel(const Intensities& intensities)
{
    std::vector<float> levels;
    for (size_t p = 0; p < intensities.pixelCount(); ++p) {
        levels.push_back(brightLevel(intensities.ofPixel(p)));
    }
    return levels.empty() ? 0.0f : quantile(levels, 0.9);
}

} // namespace

double lambertianMisfit(const Observations& sample, const std::vector<Light>& lights)
{
    const Intensities intensities = intensitiesOf(sample, lights);
    const LambertianSolver solver(lights);
    const float darkest = kObjectShare * objectLevel(intensities);
    std::vector<float> lit(lights.size()), predicted(lights.size());
    double squares = 0, sum = 0, count = 0;
    for (size_t p = 0; p < intensities.pixelCount(); ++p) {
        const auto observed = intensities.ofPixel(p);
        const float level = brightLevel(observed);
        int litCount = 0;
        for (size_t i = 0; i < lights.size(); ++i) {
            const bool counts = observed[i] > kLitShare * level; // not so if clipped
            lit[i] = counts ? 1.0f : 0.0f;
            litCount += counts;
        }
        const PixelNormal pixel = solver.solve(observed, lit);
        if (level <= darkest || litCount < kFewestLit || pixel.albedo <= 0) {
            continue;
        }
        solver.predict(pixel, predicted);
        for (size_t i = 0; i < lights.size(); ++i) {
            if (lit[i] > 0) {
                const double miss = observed[i] - predicted[i];
                squares += miss * miss;
                sum += observed[i];
                ++count;
            }
        }
    }
    return count > 0 ? std::sqrt(squares / count) / (sum / count) : std::numeric_limits<double>::quiet_NaN();
}

} // namespace nacre
