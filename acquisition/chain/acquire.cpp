#include "acquisition/chain/acquire.h"

#include <optional>

#include <fmt/format.h>

#include "acquisition/chain/material_albedo.h"
#include "acquisition/chain/material_models.h"
#include "acquisition/chain/material_samples.h"
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

// What every pixel tells of its material, by rough normals.
Segmentation findSegmentation(CaptureWalk& walk, const Capture& capture, const AcquireOptions& options,
                              const Progress& progress, NormalEstimate& estimate)
{
    std::vector<PixelTraits> traits;
    StageClock clock(estimate.times);
    walk.survey([&](const Observations& block, const NormalBlock& normals) {
        const std::vector<PixelTraits> more = clock.time(
            "materials", [&] { return pixelTraits(block, normals, estimate.rig.lights, options.samples.threads); });
        traits.insert(traits.end(), more.begin(), more.end());
    });
    progress("materials", 0);
    return clock.time("materials", [&] { return foundSegmentation(traits, capture, options.segment); });
}

// Normals, and on the way samples.
std::vector<BrdfSamples> estimateAndGather(CaptureWalk& walk, const AcquireOptions& options, Image& albedo,
                                           Acquisition& result)
{
    MaterialSamples gathered(result.segmentation, options, result.samples);
    walk.estimate(result.segmentation, [&](const Observations& block, const NormalBlock& normals) {
        gathered.gather(block, normals, result.estimate.rig.lights, albedo);
    });
    return std::move(gathered.samples);
}

BrdfInterpolant interpolate(const BrdfSamples& samples, const AcquireOptions& options, InterpolationChoice& choice)
{
    choice.options = options.interpolation;
    if (options.interpolation.automatic) {
        choice = chooseInterpolation(samples, options.interpolation);
    }
    return makeInterpolant(samples, choice.options);
}

std::vector<BakedMaterial> bakeAll(const std::vector<BrdfSamples>& samples, const AcquireOptions& options,
                                   Acquisition& result)
{
    std::vector<BakedMaterial> materials;
    for (size_t i = 0; i < samples.size(); ++i) {
        if (samples.size() > 1 && samples[i].size() == 0) {
            throw Error("",
                        fmt::format("material {} has no observation to measure a BRDF from",
                                    result.segmentation.regions[i].name),
                        "lit, unsaturated pixels with normals");
        }
        BrdfInterpolant interpolant = interpolate(samples[i], options, result.fits.emplace_back().interpolation);
        BakedBrdf baked = bakeBrdf(samples[i], interpolant, options.bake);
        materials.push_back(
            {result.segmentation.regions[i].name, std::move(interpolant), std::move(baked), glm::vec3(1)});
    }
    return materials;
}

Surface surfaceOf(const Capture& capture, const Acquisition& result, NormalMap normals, Image albedo,
                  std::vector<Material> materials)
{
    const Rig& rig = result.estimate.rig;
    Surface surface;
    surface.labels = result.segmentation.labels;
    for (size_t i = 0; i < surface.labels.size(); ++i) {
        if (normals.confidence[i] <= 0) {
            surface.labels[i] = Surface::kNoMaterial;
        }
    }
    surface.normals = std::move(normals);
    surface.materials = std::move(materials);
    surface.albedo = std::move(albedo);
    surface.scale = rig.absolute ? RadianceScale::absolute : RadianceScale::relative;
    for (size_t i = 0; i < rig.lights.size(); ++i) {
        surface.lights.push_back({capture.photographs[i].name, rig.lights[i]});
    }
    return surface;
}

} // namespace

Acquisition acquire(const Capture& capture, const AcquireOptions& options, const Progress& progress)
{
    Acquisition result;
    NormalEstimate& estimate = result.estimate;
    std::optional<Segmentation> known = knownSegmentation(capture, options.segment);
    CaptureWalk walk(capture, options, progress, estimate);
    result.segmentation = known ? std::move(*known) : findSegmentation(walk, capture, options, progress, estimate);
    const std::vector<uint8_t>& labels = result.segmentation.labels;
    Image albedo(capture.width, capture.height, 3);
    const std::vector<BrdfSamples> samples = estimateAndGather(walk, options, albedo, result);
    progress("baking", 0);
    StageClock clock(estimate.times);
    std::vector<BakedMaterial> baked = clock.time("baking", [&] { return bakeAll(samples, options, result); });
    std::vector<BrdfTable*> tables;
    for (BakedMaterial& material : baked) {
        tables.push_back(&material.baked.table);
    }
    progress("albedo", 0);
    walk.revisit([&](const Observations& block) {
        clock.time("albedo", [&] {
            refitAlbedo(block, estimate.normals, estimate.rig.lights, labels, tables, options.bake.threads, albedo);
        });
    });
    const std::vector<glm::vec3> scales = finishAlbedo(capture, labels, tables, albedo);
    for (size_t i = 0; i < baked.size(); ++i) {
        baked[i].scale = scales[i];
    }
    ReducedMaterials reduced = clock.time("model", [&] { return reduceMaterials(std::move(baked), options.ladder); });
    for (size_t i = 0; i < reduced.ladders.size(); ++i) {
        result.fits[i].ladder = std::move(reduced.ladders[i]);
    }
    result.surface = surfaceOf(selectPhotographs(capture, estimate.given), result, std::move(estimate.normals),
                               std::move(albedo), std::move(reduced.materials));
    if (options.residual.choice != ResidualChoice::none) {
        progress("residual", 0);
        clock.time("residual", [&] {
            result.surface.residual = estimateResidual(
                result.surface, options.residual, [&](const auto& visit) { walk.revisit(visit); }, result.residual);
        });
    }
    return result;
}

} // namespace nacre
