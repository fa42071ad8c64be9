#include "acquisition/checks/exposure_drift.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "acquisition/checks/self_checks.h"
#include "acquisition/lights/lights.h"
#include "engine/files/measures.h"

namespace nacre {

namespace {

constexpr int kTrendTerms = 5;
constexpr size_t kFewestDriftLights = 10; // twice the trend's terms
// Of the variance of the ratios' logarithms, with its degrees of freedom: drawn by chance 1, of a diffuse that falls
// faster than the cosine 0.0025, of light that stays on less than 0.45.
constexpr double kLeastOwnVariance = 0.64;
// Of the scatter that is left: drifts of 6 % leave less than half, well measured irradiances three quarters or more.
constexpr double kLargestScatterLeft = 0.65;

std::vector<Light> withRatios(std::vector<Light> lights, const std::vector<glm::vec3>& ratios)
{
    for (size_t i = 0; i < lights.size(); ++i) {
        lights[i].irradiance *= ratios[i];
    }
    return lights;
}

// Of the logarithms, how much of their variance is left by what goes with the direction: 1, x, y, z and z^2.
double ownVariance(const std::vector<glm::vec3>& ratios, const std::vector<Light>& lights)
{
    const auto n = static_cast<Eigen::Index>(lights.size());
    Eigen::MatrixXd terms(n, kTrendTerms);
    Eigen::VectorXd logs(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const glm::dvec3 l(lights[i].direction);
        terms.row(i) << 1, l.x, l.y, l.z, l.z * l.z;
        logs(i) = std::log(greyOf(ratios[i]));
    }
    const Eigen::VectorXd own = logs - terms * terms.colPivHouseholderQr().solve(logs);
    const double all = (logs.array() - logs.mean()).square().sum() / static_cast<double>(n - 1);
    return all > 0 ? own.squaredNorm() / static_cast<double>(n - kTrendTerms) / all : 0;
}

} // namespace

std::optional<ExposureDrift> findDrift(const PhotographRatios& found, const Observations& sample,
                                       const std::vector<Light>& lights, const NormalOptions& options)
{
    if (!found.settled || lights.size() < kFewestDriftLights || conditionOf(lights) > kWorstTellingCondition ||
        ownVariance(found.ratios, lights) < kLeastOwnVariance) {
        return std::nullopt;
    }
    const ExposureDrift drift{lambertScatter(sample, lights, options),
                              lambertScatter(sample, withRatios(lights, found.ratios), options)};
    return drift.scatterCorrected < kLargestScatterLeft * drift.scatterAsGiven ? std::optional(drift) : std::nullopt;
}

Finding correctDrift(const ExposureDrift& drift, const PhotographRatios& found, std::vector<Light>& lights)
{
    lights = withRatios(std::move(lights), found.ratios);
    std::vector<float> greys;
    std::transform(found.ratios.begin(), found.ratios.end(), std::back_inserter(greys), greyOf);
    const auto [least, most] = std::minmax_element(greys.begin(), greys.end());
    return {FindingCode::intensitiesCorrected,
            fmt::format("photographs are {:.2f} to {:.2f} times as bright as their intensities say, each by its own "
                        "share (exposures that drift?), and were corrected: Lambert's law then misses matte parts by "
                        "{:.1f} instead of {:.1f} %",
                        *least, *most, 100 * drift.scatterCorrected, 100 * drift.scatterAsGiven)};
}

} // namespace nacre
