#include "acquisition/chain/capture_preparation.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "acquisition/chain/near_surface.h"
#include "acquisition/chain/picture_checks.h"
#include "acquisition/chain/self_lit_choice.h"
#include "acquisition/checks/lambertian_misfit.h"
#include "acquisition/checks/plain_values.h"

namespace nacre {

namespace {

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

// Values that end below full scale are clipped there.
std::vector<Finding> clipAtEnd(ObservationBlocks& blocks, Observations& sample)
{
    const std::optional<glm::vec3> end = endOfValues(sample);
    if (!end) {
        return {};
    }
    clipAt(*end, sample);
    blocks.clipAt(*end);
    const float lowest = std::min({end->x, end->y, end->z});
    return {{FindingCode::valuesEnd, fmt::format("values end at {:.4g} of full scale, where many are: taken as clipped "
                                                 "there",
                                                 lowest)}};
}

// Takes what was left out away, and the corrected irradiances over.
void keepReconciled(PreparedCapture& prepared)
{
    if (prepared.nearField) {
        prepared.nearField->lights = selectItems(prepared.nearField->lights, prepared.reconciled.agreeing);
    }
    std::vector<size_t> given;
    for (const size_t i : prepared.reconciled.agreeing) {
        given.push_back(prepared.given[i]);
    }
    prepared.given = given;
    prepared.rig = selectLights(prepared.rig, prepared.reconciled.agreeing);
    prepared.rig.lights = prepared.reconciled.sample.lights;
    prepared.blocks.keepLights(prepared.reconciled.agreeing);
}

} // namespace

// All lights are calibrated before any is chosen, so that irradiances do not depend on the choice.
std::pair<PreparedCapture, Observations> reconcileCapture(const Capture& capture, const AcquireOptions& options,
                                                          StageClock& clock, const Progress& progress)
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
        0,
        {},
        {},
        {},
        options.normals.threads};
    requireSpanningLights(prepared.rig.lights, capture.folder);
    progress("reading", 0);
    clock.enter("reading");
    CaptureSample sample = captureSampleOf(prepared.blocks, prepared.rig.lights);
    progress("choosing", 0);
    clock.enter("choosing");
    std::vector<Finding> findings = clipAtEnd(prepared.blocks, sample.seen);
    SelfChecks values = checkDifferences(sample.seen, prepared.rig.lights);
    values.add(checkMask(sample.seen, !capture.maskSource.empty()));
    values.add(checkMaskBorder(capture.mask, capture.width, capture.height));
    append(findings, values.findings);
    prepared.nearField = nearFieldOf(capture, given, prepared.rig.lights);
    Observations seen = sample.seen;
    sample.seen = asIfDistant(std::move(sample.seen), prepared.localLights(), {}, options.normals.threads);
    prepared.reconciled = reconcilePhotographs(std::move(sample), options);
    append(findings, prepared.reconciled.findings);
    prepared.reconciled.findings = std::move(findings);
    prepared.reconciled.figures = std::move(values.figures);
    keepReconciled(prepared);
    const SelfChecks picture = checkPicture(capture, prepared);
    append(prepared.reconciled.findings, picture.findings);
    prepared.reconciled.figures.insert(prepared.reconciled.figures.end(), picture.figures.begin(),
                                       picture.figures.end());
    if (prepared.rig.lights.size() != seen.lightCount) {
        seen = selectLights(seen, prepared.reconciled.agreeing);
    }
    return {std::move(prepared), std::move(seen)};
}

PreparedCapture prepareCapture(const Capture& capture, const AcquireOptions& options, StageClock& clock,
                               const Progress& progress)
{
    auto [prepared, seen] = reconcileCapture(capture, options, clock, progress);
    checkSample(options, prepared);
    approachSurface(capture, seen, options, clock, progress, prepared);
    prepared.lambertianMisfit = lambertianMisfit(prepared.reconciled.sample.seen, prepared.reconciled.sample.lights);
    return std::move(prepared);
}

NormalEstimate estimateCaptureNormals(const Capture& capture, const AcquireOptions& options, const Progress& progress)
{
    StageClock clock;
    PreparedCapture prepared = prepareCapture(capture, options, clock, progress);
    const Segmentation whole = oneMaterial(capture);
    const ChosenMethod chosen = chooseMethod(prepared, whole, options);
    NormalEstimate estimate = startEstimate(prepared, chosen);
    BlockWalk walk(prepared.blocks, clock, progress, "normals");
    while (const Observations* seen = walk.next()) {
        forEachDirect(prepared, chosen, *seen, options.normals.threads, [&](const Observations& block) {
            storeNormals(block, estimateNormals(prepared, chosen, whole, block), options.keepVerdicts, estimate);
        });
    }
    finishEstimate(capture, estimate);
    estimate.times = clock.finish();
    return estimate;
}

} // namespace nacre
