#include "acquisition/chain/normal_estimation.h"

#include <algorithm>
#include <span>
#include <utility>

#include "acquisition/checks/height_consistency.h"
#include "acquisition/checks/lambertian_misfit.h"
#include "acquisition/normals/smooth_fill.h"

namespace nacre {

namespace {

constexpr int kFewestLit = 3; // lights that a normal and an albedo take

// A few thousand pixels spread evenly over the whole mask.
Observations sampleOf(ObservationBlocks& blocks)
{
    const Capture& capture = blocks.capture();
    std::vector<uint32_t> pixels;
    for (size_t pixel = 0; pixel < capture.mask.size(); ++pixel) {
        if (capture.mask[pixel]) {
            pixels.push_back(static_cast<uint32_t>(pixel));
        }
    }
    const PixelSample chosen = samplePixels(pixels, capture.width);
    Observations sample;
    while (const Observations* block = blocks.next()) {
        addToSample(*block, chosen, sample);
    }
    return sample;
}

CaptureSample captureSampleOf(ObservationBlocks& blocks, const std::vector<Light>& lights)
{
    const Capture& capture = blocks.capture();
    CaptureSample sample{sampleOf(blocks), {}, capture.irradianceGiven || capture.diffuseSphere, lights};
    for (const Photograph& photograph : capture.photographs) {
        sample.photographs.push_back(photograph.name);
    }
    return sample;
}

// Takes what was left out away, and the corrected irradiances over.
void keepReconciled(PreparedCapture& prepared)
{
    std::vector<size_t> given;
    for (const size_t i : prepared.reconciled.agreeing) {
        given.push_back(prepared.given[i]);
    }
    prepared.given = given;
    prepared.rig = selectLights(prepared.rig, prepared.reconciled.agreeing);
    prepared.rig.lights = prepared.reconciled.sample.lights;
    prepared.blocks.keepLights(prepared.reconciled.agreeing);
}

// No normals, so no samples, from pixels that are to be smoothed over.
void dropMarked(const Capture& capture, const Observations& block, NormalBlock& normals)
{
    for (size_t p = 0; p < block.pixels.size() && !capture.smooth.empty(); ++p) {
        if (capture.smooth[block.pixels[p]]) {
            normals.pixels[p] = PixelNormal{};
        }
    }
}

} // namespace

// All lights are calibrated before any is chosen, so that irradiances do not depend on the choice.
PreparedCapture prepareCapture(const Capture& capture, const AcquireOptions& options, StageClock& clock,
                               const Progress& progress)
{
    progress("lights", 0);
    clock.enter("lights");
    const Rig rig = calibrateLights(capture, options.calibration);
    const std::vector<size_t> given = chosenLights(rig.lights, options.lights);
    PreparedCapture prepared{
        ObservationBlocks(selectPhotographs(capture, given), options.normals.threads, options.byteBudget),
        given,
        selectLights(rig, given),
        {},
        {},
        0};
    requireSpanningLights(prepared.rig.lights, capture.folder);
    progress("reading", 0);
    clock.enter("reading");
    CaptureSample sample = captureSampleOf(prepared.blocks, prepared.rig.lights);
    progress("choosing", 0);
    clock.enter("choosing");
    prepared.reconciled = reconcilePhotographs(std::move(sample), options);
    keepReconciled(prepared);
    const CaptureSample& agreeing = prepared.reconciled.sample;
    prepared.checked = checkCapture(agreeing.seen, agreeing.lights, options.normals);
    prepared.lambertianMisfit = lambertianMisfit(agreeing.seen, agreeing.lights);
    return prepared;
}

NormalEstimate startEstimate(const PreparedCapture& prepared, const ChosenMethod& chosen)
{
    NormalEstimate estimate;
    estimate.given = prepared.given;
    estimate.rig = prepared.rig;
    estimate.leftOut = prepared.reconciled.leftOut;
    estimate.report = {chosen.method, prepared.reconciled.findings, prepared.lambertianMisfit};
    append(estimate.report.findings, warningsOf(prepared.rig.lights));
    append(estimate.report.findings, prepared.checked.findings);
    append(estimate.report.findings, chosen.findings);
    estimate.normals = NormalMap(prepared.blocks.capture().width, prepared.blocks.capture().height);
    estimate.verdicts.resize(prepared.rig.lights.size());
    return estimate;
}

NormalBlock estimateNormals(const PreparedCapture& prepared, const ChosenMethod& chosen, const Segmentation& materials,
                            const Observations& block)
{
    NormalBlock normals = estimateBlock(chosen, materials, block, prepared.rig.lights);
    dropMarked(prepared.blocks.capture(), block, normals);
    return normals;
}

void storeNormals(const Observations& block, const NormalBlock& normals, bool keepVerdicts, NormalEstimate& estimate)
{
    const size_t n = block.lightCount;
    for (size_t p = 0; p < block.pixels.size(); ++p) {
        const PixelNormal& pixel = normals.pixels[p];
        estimate.normals.normals[block.pixels[p]] = pixel.confidence > 0 ? pixel.normal : glm::vec3(0);
        estimate.normals.confidence[block.pixels[p]] = pixel.confidence;
        const auto verdicts = std::span(normals.verdicts).subspan(p * n, n);
        estimate.pixelsWithoutNormal += pixel.confidence <= 0;
        estimate.pixelsInShade += std::count(verdicts.begin(), verdicts.end(), Verdict::used) < kFewestLit;
        for (size_t i = 0; i < n; ++i) {
            VerdictCounts& counts = estimate.verdicts[i];
            switch (normals.verdicts[p * n + i]) {
            case Verdict::used:
                ++counts.used;
                break;
            case Verdict::shadow:
                ++counts.shadow;
                break;
            case Verdict::highlight:
                ++counts.highlight;
                break;
            case Verdict::saturated:
                ++counts.saturated;
                break;
            }
        }
    }
    if (keepVerdicts) {
        estimate.pixels.insert(estimate.pixels.end(), block.pixels.begin(), block.pixels.end());
        estimate.everyVerdict.insert(estimate.everyVerdict.end(), normals.verdicts.begin(), normals.verdicts.end());
    }
}

void finishEstimate(const Capture& capture, NormalEstimate& estimate)
{
    append(estimate.report.findings, heightWarnings(estimate.normals));
    if (!capture.smooth.empty()) {
        estimate.pixelsSmoothed = fillSmoothly(estimate.normals, capture.smooth, capture.mask);
        estimate.pixelsWithoutNormal -= estimate.pixelsSmoothed;
    }
}

NormalEstimate estimateCaptureNormals(const Capture& capture, const AcquireOptions& options, const Progress& progress)
{
    StageClock clock;
    PreparedCapture prepared = prepareCapture(capture, options, clock, progress);
    const ChosenMethod chosen = chooseMethod(prepared.reconciled.sample, prepared.checked, options.normals);
    NormalEstimate estimate = startEstimate(prepared, chosen);
    const Segmentation whole = oneMaterial(capture);
    BlockWalk walk(prepared.blocks, clock, progress, "normals");
    while (const Observations* block = walk.next()) {
        storeNormals(*block, estimateNormals(prepared, chosen, whole, *block), options.keepVerdicts, estimate);
    }
    finishEstimate(capture, estimate);
    estimate.times = clock.finish();
    return estimate;
}

} // namespace nacre
