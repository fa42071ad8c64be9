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
        samples.domain = capturedDomain(lights, options.bake.coordinates);
        const std::vector<glm::vec3> factors = albedoFactors(block, normals, lights);
        storeAlbedo(block, factors, albedo);
        gatherSamples(block, normals, factors, lights, share, options.samples, samples, result.samples);
    });
    return samples;
}

BakedBrdf bake(const BrdfSamples& samples, const AcquireOptions& options, InterpolationChoice& choice)
{
    choice.options = options.interpolation;
    if (options.interpolation.automatic) {
        choice = chooseInterpolation(samples, options.interpolation);
    }
    return bakeBrdf(samples, choice.options, options.bake);
}

Surface surfaceOf(const Capture& capture, const Rig& rig, NormalMap normals, Image albedo, BakedBrdf baked)
{
    normaliseAlbedo(albedo, baked.table);
    Surface surface = transferredSurface(normals, {capture.name, std::move(baked.table), std::move(baked.coverage)});
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
    BakedBrdf baked = clock.time("baking", [&] { return bake(samples, options, result.interpolation); });
    progress("albedo", 0);
    walk.revisit([&](const Observations& block) {
        clock.time("albedo", [&] {
            refitAlbedo(block, estimate.normals, estimate.rig.lights, baked.table, options.bake.threads, albedo);
        });
    });
    if (!capture.smooth.empty()) {
        fillSmoothly(albedo, capture.smooth, capture.mask);
    }
    result.surface = surfaceOf(selectPhotographs(capture, estimate.given), estimate.rig, std::move(estimate.normals),
                               std::move(albedo), std::move(baked));
    return result;
}

} // namespace nacre
