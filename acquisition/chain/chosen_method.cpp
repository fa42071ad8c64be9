#include "acquisition/chain/chosen_method.h"

#include <algorithm>

#include <fmt/format.h>

#include "acquisition/chain/material_blocks.h"
#include "acquisition/exemplar/normal_method.h"

namespace nacre {

namespace {

constexpr size_t kFewestInSample = 50;

std::vector<Observations> samplesByMaterial(const Observations& sample, const Segmentation& materials)
{
    std::vector<Observations> samples(materials.regions.size());
    forEachMaterial(
        sample, {}, {}, samples.size(),
        [&](uint32_t pixel) -> size_t { return materials.inner[pixel] ? materials.labels[pixel] : kUnlabelled; },
        [&](size_t material, const BlockPart& part) { samples[material] = part.seen; });
    return samples;
}

bool hasOneAlbedo(const NormalReport& report)
{
    return std::any_of(report.findings.begin(), report.findings.end(),
                       [](const Finding& finding) { return finding.code == FindingCode::oneAlbedo; });
}

} // namespace

ChosenMethod chooseMethod(const CaptureSample& sample, const CheckedSample& checked, const NormalOptions& options)
{
    NormalReport report;
    ChosenMethod chosen;
    chosen.estimators = {
        makeNormalEstimator(intensitiesOf(sample.seen, sample.lights), sample.lights, options, report)};
    chosen.method = report.method;
    chosen.methods = {report.method};
    chosen.haveOneAlbedo = {hasOneAlbedo(report)};
    chosen.heldOutError = report.heldOutError;
    chosen.findings = std::move(report.findings);
    const SelfChecks own = checkMethod(checked, chosen.method, chosen.estimators.front());
    append(chosen.findings, own.findings);
    chosen.figures = own.figures;
    return chosen;
}

ChosenMethod chooseMethod(const CaptureSample& sample, const CheckedSample& checked, const Segmentation& materials,
                          const NormalOptions& options)
{
    const std::vector<MaterialRegion>& regions = materials.regions;
    if (regions.size() == 1) {
        return chooseMethod(sample, checked, options);
    }
    const std::vector<Observations> samples = samplesByMaterial(sample.seen, materials);
    const auto largest = std::max_element(regions.begin(), regions.end(),
                                          [](const auto& a, const auto& b) { return a.pixels < b.pixels; });
    ChosenMethod chosen;
    for (size_t m = 0; m < regions.size(); ++m) {
        const Observations& own = samples[m].pixels.size() >= kFewestInSample ? samples[m] : sample.seen;
        NormalReport report;
        chosen.estimators.push_back(
            makeNormalEstimator(intensitiesOf(own, sample.lights), sample.lights, options, report));
        chosen.methods.push_back(report.method);
        chosen.haveOneAlbedo.push_back(hasOneAlbedo(report));
        for (const Finding& finding : report.findings) {
            chosen.findings.push_back({finding.code, fmt::format("{}: {}", regions[m].name, finding.text)});
        }
        if (&regions[m] == &*largest) {
            chosen.method = report.method;
        }
    }
    return chosen;
}

NormalBlock estimateBlock(const NormalEstimator& estimator, const Observations& block, const std::vector<Light>& lights)
{
    return estimator(intensitiesOf(block, lights));
}

NormalBlock estimateBlock(const ChosenMethod& chosen, const Segmentation& materials, const Observations& block,
                          const std::vector<Light>& lights)
{
    if (chosen.estimators.size() == 1) {
        return estimateBlock(chosen.estimators.front(), block, lights);
    }
    NormalBlock all{std::vector<PixelNormal>(block.pixels.size()), std::vector<Verdict>(block.saturated.size())};
    forEachMaterial(
        block, {}, {}, chosen.estimators.size(), [&](uint32_t pixel) -> size_t { return materials.labels[pixel]; },
        [&](size_t material, const BlockPart& part) {
            const NormalBlock own = estimateBlock(chosen.estimators[material], part.seen, lights);
            for (size_t p = 0; p < part.places.size(); ++p) {
                all.pixels[part.places[p]] = own.pixels[p];
                std::copy_n(own.verdicts.begin() + static_cast<std::ptrdiff_t>(p * lights.size()), lights.size(),
                            all.verdicts.begin() + static_cast<std::ptrdiff_t>(part.places[p] * lights.size()));
            }
        });
    return all;
}

} // namespace nacre
