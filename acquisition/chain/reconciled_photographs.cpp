#include "acquisition/chain/reconciled_photographs.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "acquisition/checks/discordant_photographs.h"
#include "acquisition/checks/exposure_drift.h"
#include "acquisition/checks/intensity_refinement.h"

namespace nacre {

namespace {

void leaveOut(const std::vector<DiscordantPhotograph>& discordant, ReconciledPhotographs& result)
{
    CaptureSample& sample = result.sample;
    std::vector<std::string> names;
    result.agreeing.clear();
    for (size_t i = 0; i < sample.photographs.size(); ++i) {
        const bool agrees =
            std::none_of(discordant.begin(), discordant.end(), [&](const auto& d) { return d.index == i; });
        (agrees ? names : result.leftOut).push_back(sample.photographs[i]);
        if (agrees) {
            result.agreeing.push_back(i);
        }
    }
    sample.seen = selectLights(sample.seen, result.agreeing);
    sample.lights = selectLights(sample.lights, result.agreeing);
    sample.photographs = names;
}

} // namespace

ReconciledPhotographs reconcilePhotographs(CaptureSample given, const AcquireOptions& options)
{
    ReconciledPhotographs result{std::move(given), {}, {}, {}, {}};
    CaptureSample& sample = result.sample;
    result.agreeing.resize(sample.lights.size());
    std::iota(result.agreeing.begin(), result.agreeing.end(), size_t{0});
    if (!options.correctIntensities || !canCompare(sample.seen)) {
        return result;
    }
    PhotographRatios ratios = estimateIntensityRatios(sample.seen, sample.lights, options.normals);
    const std::vector<DiscordantPhotograph> discordant = findDiscordant(ratios, sample.lights);
    if (!discordant.empty()) {
        result.findings.push_back(describeDiscordant(discordant, ratios, sample.photographs));
        leaveOut(discordant, result);
        ratios = estimateIntensityRatios(sample.seen, sample.lights, options.normals);
    }
    const std::optional<ExposureDrift> drift =
        sample.irradiancesKnown ? findDrift(ratios, sample.seen, sample.lights, options.normals) : std::nullopt;
    if (drift) {
        result.findings.push_back(correctDrift(*drift, ratios, sample.lights));
        return result;
    }
    if (sample.irradiancesKnown) {
        ratios = confirmedRatios(ratios, sample.seen, sample.lights, options.normals);
    }
    append(result.findings, correctIntensities(ratios, sample.photographs, sample.irradiancesKnown, sample.lights));
    return result;
}

} // namespace nacre
