#include "acquisition/acquire.h"

#include <algorithm>

#include "acquisition/brdf/albedo_factor.h"
#include "acquisition/normals/smooth_fill.h"

namespace nacre {

namespace {

void storeAlbedo(const Observations& block, const std::vector<glm::vec3>& factors, Image& albedo)
{
    for (size_t p = 0; p < factors.size(); ++p) {
        const uint32_t pixel = block.pixels[p];
        albedo.setRgb(static_cast<int>(pixel % albedo.width), static_cast<int>(pixel / albedo.width), factors[p]);
    }
}

// Normals, and on the way samples of f with a first albedo factor of each pixel.
BrdfSamples estimateAndGather(CaptureWalk& walk, const Capture& capture, const AcquireOptions& options, Image& albedo,
                              Acquisition& result)
{
    BrdfSamples samples;
    walk.estimate([&](const Observations& block, const NormalBlock& normals) {
        const std::vector<Light>& lights = result.estimate.rig.lights; // known once blocks come
        const double observations = static_cast<double>(capture.maskPixels) * static_cast<double>(lights.size());
        const double share = static_cast<double>(options.samples.most) / std::max(observations, 1.0);
        samples.domain = tableDomain(lights, options.bake);
        const std::vector<glm::vec3> factors = albedoFactors(block, normals, lights);
        storeAlbedo(block, factors, albedo);
        gatherSamples(block, normals, factors, lights, share, options.samples, samples, result.samples);
    });
    return samples;
}

BrdfInterpolant interpolate(const BrdfSamples& samples, const AcquireOptions& options, InterpolationChoice& choice)
{
    choice.options = options.interpolation;
    if (options.interpolation.automatic) {
        choice = chooseInterpolation(samples, options.interpolation);
    }
    return makeInterpolant(samples, choice.options);
}

// The material as small as it was asked for, or its full table. `scale`: of the table over the interpolant.
Material compactMaterial(const std::string& name, BakedBrdf baked, const BrdfInterpolant& interpolant,
                         const glm::vec3& scale, const LadderOptions& options, ModelLadder& ladder)
{
    if (options.isAsked()) {
        const auto scaled = [&](const glm::vec3& unit) {
            InterpolatedValue value = interpolant(unit);
            value.value *= scale;
            return value;
        };
        ladder = climbLadder(scaled, baked.table, options);
    }
    if (!ladder.taken) {
        return {name, std::move(baked.table), std::move(baked.coverage), {}};
    }
    const CompactBrdf& model = ladder.steps[*ladder.taken].model;
    return {name, expandedTable(model, baked.table), {}, model};
}

Surface surfaceOf(const Capture& capture, const Rig& rig, const NormalMap& normals, Image albedo,
                  const Material& material)
{
    Surface surface = transferredSurface(normals, material);
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
    CaptureWalk walk(capture, options, progress, estimate);
    Image albedo(capture.width, capture.height, 3);
    const BrdfSamples samples = estimateAndGather(walk, capture, options, albedo, result);
    progress("baking", 0);
    StageClock clock(estimate.times);
    const BrdfInterpolant interpolant =
        clock.time("baking", [&] { return interpolate(samples, options, result.interpolation); });
    BakedBrdf baked = clock.time("baking", [&] { return bakeBrdf(samples, interpolant, options.bake); });
    progress("albedo", 0);
    walk.revisit([&](const Observations& block) {
        clock.time("albedo", [&] {
            refitAlbedo(block, estimate.normals, estimate.rig.lights, baked.table, options.bake.threads, albedo);
        });
    });
    if (!capture.smooth.empty()) {
        fillSmoothly(albedo, capture.smooth, capture.mask);
    }
    const glm::vec3 scale = normaliseAlbedo(albedo, baked.table);
    const Material material = clock.time("model", [&] {
        return compactMaterial(capture.name, std::move(baked), interpolant, scale, options.ladder, result.ladder);
    });
    result.surface = surfaceOf(selectPhotographs(capture, estimate.given), estimate.rig, estimate.normals,
                               std::move(albedo), material);
    return result;
}

} // namespace nacre
