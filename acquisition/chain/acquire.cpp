#include "acquisition/chain/acquire.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "acquisition/brdf/reciprocity.h"
#include "acquisition/chain/cast_shadow_choice.h"
#include "acquisition/chain/material_albedo.h"
#include "acquisition/chain/material_models.h"
#include "acquisition/chain/material_samples.h"
#include "acquisition/chain/remeasured_sample.h"
#include "acquisition/chain/self_lit_choice.h"
#include "acquisition/residual/residual_estimate.h"
#include "engine/files/error.h"

namespace nacre {

namespace {

// Before anything is estimated, so that labels that are no good are refused at once. Empty where labels are to be
// found.
std::optional<Segmentation> knownSegmentation(const Capture& capture, const SegmentOptions& options)
{
    if (options.source == SegmentSource::found) {
        return {};
    }
    const bool named = options.source == SegmentSource::picture;
    const bool captured = options.source == SegmentSource::asCaptured && !capture.labelsFile.empty();
    if (!named && !captured) {
        return oneMaterial(capture);
    }
    const std::filesystem::path& file = named ? options.picture : capture.labelsFile;
    Segmentation segmentation = segmentationOf(loadLabelPicture(file, capture), capture);
    segmentation.source = file.string();
    return segmentation;
}

// What every pixel tells of its material, by rough normals of a method that asks nothing of the object as a whole.
Segmentation findSegmentation(PreparedCapture& prepared, const Capture& capture, const AcquireOptions& options,
                              StageClock& clock, const Progress& progress)
{
    NormalOptions rough = options.normals;
    rough.method = NormalMethod::consensus;
    const ChosenMethod consensus = chooseMethod(prepared.reconciled.sample, prepared.checked, rough);
    const Segmentation whole = oneMaterial(capture);
    std::vector<PixelTraits> traits;
    BlockWalk walk(prepared.blocks, clock, progress, "materials");
    while (const Observations* block = walk.next()) {
        const NormalBlock normals = estimateNormals(prepared, consensus, whole, *block);
        const std::vector<PixelTraits> more =
            pixelTraits(*block, normals, prepared.rig.lights, options.samples.threads);
        traits.insert(traits.end(), more.begin(), more.end());
    }
    return foundSegmentation(traits, capture, options.segment);
}

struct BakedMaterials {
    std::vector<BakedMaterial> materials;
    std::vector<InterpolationChoice> interpolations; // one a material
};

BakedMaterials bakeAll(const std::vector<BrdfSamples>& samples, const Segmentation& segmentation,
                       const AcquireOptions& options)
{
    const InterpolationOptions& asked = options.interpolation;
    BakedMaterials all;
    for (size_t i = 0; i < samples.size(); ++i) {
        const std::string& name = segmentation.regions[i].name;
        if (samples.size() > 1 && samples[i].size() == 0) {
            throw Error("", fmt::format("material {} has no observation to measure a BRDF from", name),
                        "lit, unsaturated pixels with normals");
        }
        all.interpolations.push_back(asked.automatic ? chooseInterpolation(samples[i], asked)
                                                     : InterpolationChoice{.options = asked});
        BrdfInterpolant interpolant = makeInterpolant(samples[i], all.interpolations.back().options);
        BakedBrdf baked = bakeBrdf(samples[i], interpolant, options.bake);
        all.materials.push_back({name, std::move(interpolant), std::move(baked), glm::vec3(1)});
    }
    return all;
}

// Refits every pixel's factor to its material's table; the tables take what the factors' mean comes to.
Image finishAlbedo(const Capture& capture, PreparedCapture& prepared, const NormalMap& normals,
                   const std::vector<uint8_t>& labels, const std::vector<uint8_t>& haveOneAlbedo, Image albedo,
                   std::vector<BakedMaterial>& baked, int threads, StageClock& clock, const Progress& progress)
{
    std::vector<BrdfTable*> tables;
    for (BakedMaterial& material : baked) {
        tables.push_back(&material.baked.table);
    }
    const LocalLights lights = prepared.localLights();
    BlockWalk walk(prepared.blocks, clock, progress, "albedo");
    while (const Observations* block = walk.next()) {
        refitAlbedo(*block, normals, lights, labels, tables, threads, albedo);
    }
    const std::vector<glm::vec3> scales = finishAlbedo(capture, labels, haveOneAlbedo, tables, albedo);
    for (size_t i = 0; i < baked.size(); ++i) {
        baked[i].scale = scales[i];
    }
    return albedo;
}

Surface surfaceOf(const Capture& capture, const PreparedCapture& prepared, NormalMap normals,
                  std::vector<uint8_t> labels, Image albedo, std::vector<Material> materials)
{
    const Rig& rig = prepared.rig;
    const std::vector<Light> lights = placedLights(capture, prepared.given, rig.lights, prepared.nearField);
    Surface surface;
    surface.labels = std::move(labels);
    for (size_t i = 0; i < surface.labels.size(); ++i) {
        if (normals.confidence[i] <= 0) {
            surface.labels[i] = Surface::kNoMaterial;
        }
    }
    surface.normals = std::move(normals);
    surface.materials = std::move(materials);
    surface.albedo = std::move(albedo);
    surface.transfer = capture.curve == TransferCurve::srgb     ? "srgb"
                       : capture.curve == TransferCurve::linear ? "linear"
                                                                : "";
    if (capture.pixelsPerMillimetre) {
        surface.pixelsPerMillimetre = *capture.pixelsPerMillimetre / capture.window.box;
    }
    surface.scale = rig.absolute ? RadianceScale::absolute : RadianceScale::relative;
    for (size_t i = 0; i < lights.size(); ++i) {
        surface.lights.push_back({capture.photographs[prepared.given[i]].name, lights[i]});
    }
    if (prepared.nearField) { // it is drawn by them
        surface.camera = cameraPlaceOf(*prepared.nearField, extentOf(capture).width);
        surface.height = prepared.guess.height;
        surface.places = pixelPlaces(surface);
    }
    return surface;
}

// Places and predictions of a surface that has got another height.
void standOnHeight(Surface& surface, ResidualRows& rows)
{
    if (isPlaced(surface)) {
        surface.places.clear();
        surface.places = pixelPlaces(surface);
        rows.predicted = predictedRows(LightBalls(surface, 0, 1), rows.pixels, surface.lights.size());
    }
}

// Cast shadows and the residual layer: what lights left out say for.
void explainLeftOut(const Measurement& measurement, ObservationBlocks& blocks, StageClock& clock,
                    const Progress& progress, Acquisition& result)
{
    const AcquireOptions& options = measurement.options;
    LeftOut leftOut =
        leaveOut(result.surface, blocks, [&](const Observations& sample, std::span<const size_t> without) {
            return remeasured(measurement, sample, without);
        });
    if (options.castShadows) {
        progress("shadows", 0);
        clock.enter("shadows");
        CastShadows shadows = findCastShadows(measurement, blocks, std::move(leftOut), options.residual.choice);
        result.shadows = std::move(shadows.report);
        leftOut = std::move(shadows.leftOut);
        if (result.shadows.areKept) {
            result.surface.height = std::move(shadows.height);
            result.surface.horizon = std::move(shadows.horizon);
            result.surface.castsShadows = true;
            standOnHeight(result.surface, leftOut.rows);
        }
    }
    progress("residual", 0);
    clock.enter("residual");
    EstimatedResidual residual = estimateResidual(result.surface, options.residual, leftOut, blocks);
    result.surface.residual = std::move(residual.layer);
    result.residual = std::move(residual.report);
    const ResidualReport& report = result.residual;
    if (report.choice != ResidualChoice::none && report.whyNot.empty()) {
        result.surface.leftOutDecibels = report.fit.isKept ? report.fit.layerPsnr : report.fit.brdfPsnr;
    }
}

// Samples anew, as coarse tables of the first ones judge them; not where a material has none, which is refused later.
void judgeSamples(PreparedCapture& prepared, const Capture& capture, const Segmentation& segmentation,
                  const AcquireOptions& options, StageClock& clock, const Progress& progress, NormalsAndSamples& result)
{
    clock.enter("samples");
    InterpolationOptions interpolation = options.interpolation;
    interpolation.completed = false; // it is asked where it was measured alone
    std::vector<BrdfTable> coarse;
    std::vector<BrdfTable*> tables;
    for (const BrdfSamples& samples : result.gathered.samples) {
        if (samples.size() == 0) {
            return;
        }
        BakeOptions bake = options.bake;
        bake.size = coarseTableSize(samples.domain);
        coarse.push_back(
            bakeBrdf(options.bake.coordinates ? samples : reciprocalSamples(samples), interpolation, bake).table);
    }
    std::transform(coarse.begin(), coarse.end(), std::back_inserter(tables), [](BrdfTable& table) { return &table; });
    const LocalLights lights = prepared.localLights();
    MaterialSamples judged = startSamples(capture, lights, segmentation, options.bake);
    judged.counts = result.gathered.counts;
    judged.albedo = std::move(result.gathered.albedo);
    shareAlbedos(result.estimate.normals, segmentation.labels, result.chosen.haveOneAlbedo, judged.albedo);
    BlockWalk walk(prepared.blocks, clock, progress, "samples");
    while (const Observations* seen = walk.next()) {
        forEachDirect(prepared, result.chosen, *seen, options.normals.threads, [&](const Observations& block) {
            gatherJudgedSamples(block, result.estimate.normals, lights, segmentation, tables,
                                result.chosen.haveOneAlbedo, options, judged);
        });
    }
    result.gathered = std::move(judged);
}

// Samples that were gathered one-way become reciprocal ones, but of materials that are not. Normals of other methods
// than exemplar follow Lambert's law: what they err by on gloss looks the same, so that they tell nothing.
void settleCoordinates(const Segmentation& segmentation, const AcquireOptions& options, NormalsAndSamples& result)
{
    for (size_t m = 0; m < result.gathered.samples.size() && !options.bake.coordinates; ++m) {
        BrdfSamples& samples = result.gathered.samples[m];
        const std::vector<NormalMethod>& methods = result.chosen.methods;
        const bool canTell = methods[m % methods.size()] == NormalMethod::exemplar && samples.size() > 0;
        const double ratio = canTell ? errorRatioOneWay(samples, options.interpolation).value_or(1.0) : 1.0;
        if (ratio > kMostErrorRatioOneWay) {
            samples = reciprocalSamples(std::move(samples));
            continue;
        }
        result.estimate.report.findings.push_back(
            {FindingCode::notReciprocal,
             fmt::format("{}: the BRDF is not reciprocal: with f(l, v) and f(v, l) apart, held-out photographs are "
                         "predicted with {:.0f} % less error",
                         segmentation.regions[m].name, 100 * (1 - ratio))});
    }
}

} // namespace

NormalsAndSamples estimateAndSample(PreparedCapture& prepared, const Capture& capture, const Segmentation& segmentation,
                                    const AcquireOptions& options, StageClock& clock, const Progress& progress)
{
    progress("choosing", 0);
    clock.enter("choosing");
    const ChosenMethod chosen = chooseMethod(prepared, segmentation, options);
    const LocalLights lights = prepared.localLights();
    NormalsAndSamples result{startEstimate(prepared, chosen), startSamples(capture, lights, segmentation, options.bake),
                             chosen};
    BlockWalk walk(prepared.blocks, clock, progress, "normals");
    while (const Observations* seen = walk.next()) {
        forEachDirect(prepared, chosen, *seen, options.normals.threads, [&](const Observations& block) {
            clock.enter("normals");
            const NormalBlock normals = estimateNormals(prepared, chosen, segmentation, block);
            storeNormals(block, normals, options.keepVerdicts, result.estimate);
            clock.enter("samples");
            gatherSamples(block, normals, lights, segmentation, options, result.gathered);
        });
    }
    finishEstimate(capture, result.estimate);
    judgeSamples(prepared, capture, segmentation, options, clock, progress, result);
    settleCoordinates(segmentation, options, result);
    return result;
}

Acquisition acquire(const Capture& capture, const AcquireOptions& options, const Progress& progress)
{
    Acquisition result;
    StageClock clock;
    std::optional<Segmentation> known = knownSegmentation(capture, options.segment);
    PreparedCapture prepared = prepareCapture(capture, options, clock, progress);
    result.segmentation = known ? std::move(*known) : findSegmentation(prepared, capture, options, clock, progress);
    auto [estimate, gathered, chosen] =
        estimateAndSample(prepared, capture, result.segmentation, options, clock, progress);
    progress("baking", 0);
    clock.enter("baking");
    auto [baked, interpolations] = bakeAll(gathered.samples, result.segmentation, options);
    Image albedo = finishAlbedo(capture, prepared, estimate.normals, result.segmentation.labels, chosen.haveOneAlbedo,
                                std::move(gathered.albedo), baked, options.bake.threads, clock, progress);
    clock.enter("model");
    ReducedMaterials reduced = reduceMaterials(std::move(baked), options.ladder);
    for (size_t i = 0; i < reduced.ladders.size(); ++i) {
        result.fits.push_back({interpolations[i], std::move(reduced.ladders[i])});
    }
    result.surface = surfaceOf(capture, prepared, std::move(estimate.normals), result.segmentation.labels,
                               std::move(albedo), std::move(reduced.materials));
    if (options.residual.choice != ResidualChoice::none || options.castShadows) {
        progress("left out", 0);
        clock.enter("left out");
        const Measurement measurement{prepared, chosen, result.segmentation, options, interpolations, result.surface};
        explainLeftOut(measurement, prepared.blocks, clock, progress, result);
    }
    result.samples = gathered.counts;
    result.estimate = std::move(estimate);
    result.estimate.times = clock.finish();
    return result;
}

} // namespace nacre
