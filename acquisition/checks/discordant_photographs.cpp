#include "acquisition/checks/discordant_photographs.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "acquisition/lights/lights.h"
#include "engine/files/measures.h"

namespace nacre {

namespace {

// Far more: in times the median scatter, and in robust standard deviations of the logarithms. What scatters less than
// calibration and interreflection do (kLeastTolerance) does no harm.
constexpr float kFactor = 3;
constexpr float kSigmas = 4;
// Fewer photographs do not outvote one.
constexpr size_t kFewestLeft = 6;
constexpr double kWorstCondition = 30; // what is left has to span space well

float medianScatter(const PhotographRatios& ratios)
{
    std::vector<float> spreads;
    for (const PhotographScatter& scatter : ratios.scatters) {
        spreads.push_back(scatter.spread);
    }
    return quantile(spreads, 0.5);
}

float largestUsual(const PhotographRatios& ratios)
{
    const float median = medianScatter(ratios);
    std::vector<float> deviations;
    for (const PhotographScatter& scatter : ratios.scatters) {
        deviations.push_back(scatter.spread > 0 ? std::abs(std::log(scatter.spread / median)) : 0.0f);
    }
    const float sigma = 1.4826f * quantile(deviations, 0.5);
    return std::max(kLeastTolerance, median * std::max(kFactor, std::exp(kSigmas * sigma)));
}

bool canBeSpared(const std::vector<DiscordantPhotograph>& discordant, const std::vector<Light>& lights)
{
    std::vector<Light> left;
    for (size_t i = 0; i < lights.size(); ++i) {
        if (std::none_of(discordant.begin(), discordant.end(), [&](const auto& d) { return d.index == i; })) {
            left.push_back(lights[i]);
        }
    }
    return left.size() >= kFewestLeft && conditionOf(left) < kWorstCondition;
}

} // namespace

std::vector<DiscordantPhotograph> findDiscordant(const PhotographRatios& ratios, const std::vector<Light>& lights)
{
    std::vector<DiscordantPhotograph> discordant;
    if (ratios.scatters.empty()) {
        return discordant;
    }
    const float usual = largestUsual(ratios);
    for (size_t i = 0; i < ratios.scatters.size(); ++i) {
        const PhotographScatter& scatter = ratios.scatters[i];
        if (scatter.spread > usual || scatter.litShare < kLeastLitShare) {
            discordant.push_back({i, scatter});
        }
    }
    return canBeSpared(discordant, lights) ? discordant : std::vector<DiscordantPhotograph>{};
}

Finding describeDiscordant(const std::vector<DiscordantPhotograph>& discordant, const PhotographRatios& ratios,
                           const std::vector<std::string>& names)
{
    std::string list;
    for (const DiscordantPhotograph& d : discordant) {
        const std::string figure =
            d.scatter.litShare < kLeastLitShare
                ? fmt::format("lit on {:.0f} % of what faces its light", 100 * d.scatter.litShare)
                : fmt::format("{:.1f} %", 100 * d.scatter.spread);
        list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", names[d.index], figure);
    }
    return {FindingCode::photographsLeftOut,
            fmt::format("{} photograph(s) left out, since no intensity makes them agree with the others, whose pixels "
                        "scatter by {:.1f} %: {}",
                        discordant.size(), 100 * medianScatter(ratios), list)};
}

} // namespace nacre
