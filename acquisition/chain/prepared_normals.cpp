#include "acquisition/chain/prepared_normals.h"

#include <algorithm>

#include "acquisition/checks/discordant_photographs.h"
#include "acquisition/checks/intensity_refinement.h"
#include "acquisition/checks/lambertian_residual.h"
#include "acquisition/exemplar/normal_method.h"

namespace nacre {

namespace {

// All entries but those of the discordant photographs.
std::vector<size_t> agreeingPhotographs(const std::vector<DiscordantPhotograph>& discordant, size_t count)
{
    std::vector<size_t> agreeing;
    for (size_t i = 0; i < count; ++i) {
        if (std::none_of(discordant.begin(), discordant.end(), [&](const auto& d) { return d.index == i; })) {
            agreeing.push_back(i);
        }
    }
    return agreeing;
}

std::vector<std::string> selected(const std::vector<std::string>& names, const std::vector<size_t>& chosen)
{
    std::vector<std::string> result;
    for (const size_t i : chosen) {
        result.push_back(names[i]);
    }
    return result;
}

void reconcilePhotographs(const CaptureSample& capture, const AcquireOptions& options, Observations& sample,
                          PreparedNormals& prepared)
{
    if (!options.correctIntensities || !canCompare(sample)) {
        return;
    }
    std::vector<std::string> names = capture.photographs, remarks;
    PhotographRatios ratios = estimateIntensityRatios(sample, prepared.lights, options.normals);
    const std::vector<DiscordantPhotograph> discordant = findDiscordant(ratios, prepared.lights);
    if (!discordant.empty()) {
        remarks.push_back(describeDiscordant(discordant, ratios, names));
        prepared.agreeing = agreeingPhotographs(discordant, names.size());
        sample = selectLights(sample, prepared.agreeing);
        prepared.lights = selectLights(prepared.lights, prepared.agreeing);
        names = selected(names, prepared.agreeing);
        ratios = estimateIntensityRatios(sample, prepared.lights, options.normals);
    }
    if (capture.irradiancesKnown) {
        ratios = confirmedRatios(ratios, sample, prepared.lights, options.normals);
    }
    prepared.report.remarks = correctIntensities(ratios, names, capture.irradiancesKnown, prepared.lights);
    prepared.report.remarks.insert(prepared.report.remarks.begin(), remarks.begin(), remarks.end());
}

} // namespace

PreparedNormals preparePhotographs(CaptureSample& capture, const AcquireOptions& options)
{
    PreparedNormals prepared;
    prepared.agreeing = agreeingPhotographs({}, capture.lights.size());
    prepared.lights = capture.lights;
    reconcilePhotographs(capture, options, capture.seen, prepared);
    for (const std::string& warning : warningsOf(prepared.lights)) {
        prepared.report.remarks.push_back(warning);
    }
    prepared.checked =
        checkCapture(capture.seen, capture.width, prepared.lights, options.normals, prepared.report.remarks);
    prepared.report.lambertianResidual = lambertianResidual(capture.seen, prepared.lights);
    return prepared;
}

void completeNormals(const CaptureSample& capture, const AcquireOptions& options, PreparedNormals& prepared)
{
    prepared.estimator = makeNormalEstimator(intensitiesOf(capture.seen, prepared.lights), prepared.lights,
                                             options.normals, prepared.report);
    for (const std::string& warning : methodWarnings(prepared.checked, prepared.report.method, prepared.estimator)) {
        prepared.report.remarks.push_back(warning);
    }
}

PreparedNormals prepareNormals(CaptureSample capture, const AcquireOptions& options)
{
    PreparedNormals prepared = preparePhotographs(capture, options);
    completeNormals(capture, options, prepared);
    return prepared;
}

NormalBlock estimateBlock(const NormalEstimator& estimator, const Observations& block, const std::vector<Light>& lights)
{
    NormalBlock normals = estimator(intensitiesOf(block, lights));
    for (size_t i = 0; i < block.saturated.size(); ++i) {
        if (block.saturated[i]) {
            normals.verdicts[i] = Verdict::saturated;
        }
    }
    return normals;
}

} // namespace nacre
