#include "evaluation/charts/chart_baking.h"

#include <chrono>

#include "acquisition/chain/material_albedo.h"
#include "acquisition/segmentation/label_picture.h"

namespace nacre {

namespace {

Segmentation segmentationOfCapture(const Capture& capture)
{
    return capture.labelsFile.empty() ? oneMaterial(capture)
                                      : segmentationOf(loadLabelPicture(capture.labelsFile, capture), capture);
}

} // namespace

ChartBaking::ChartBaking(const Capture& capture, const AcquireOptions& options, const Progress& progress)
    : capture_(capture), options_(options), segmentation_(segmentationOfCapture(capture)),
      walk_(capture, options, progress, estimate_), firstAlbedo_(capture.width, capture.height, 3),
      samples_(segmentation_, options, counts_)
{
    walk_.estimate(segmentation_, [&](const Observations& block, const NormalBlock& normals) {
        samples_.gather(block, normals, estimate_.rig.lights, firstAlbedo_);
    });
    surface_.normals = estimate_.normals;
    surface_.labels = segmentation_.labels;
    for (size_t i = 0; i < surface_.labels.size(); ++i) {
        if (surface_.normals.confidence[i] <= 0) {
            surface_.labels[i] = Surface::kNoMaterial;
        }
    }
}

Surface ChartBaking::bake(const BrdfSetting& setting, double& seconds)
{
    InterpolationOptions interpolation = options_.interpolation;
    interpolation.method = setting.interpolation;
    interpolation.k = setting.k;
    Surface surface = surface_;
    const auto start = std::chrono::steady_clock::now();
    for (size_t i = 0; i < samples_.samples.size(); ++i) {
        BakeOptions bake = options_.bake;
        bake.size = chartTableSizes(tableSize(samples_.samples[i].domain))[setting.size];
        BakedBrdf baked = bakeBrdf(samples_.samples[i], interpolation, bake);
        surface.materials.push_back(
            {segmentation_.regions[i].name, std::move(baked.table), std::move(baked.coverage), {}});
    }
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::vector<BrdfTable*> tables;
    for (Material& material : surface.materials) {
        tables.push_back(&material.table);
    }
    surface.albedo = firstAlbedo_;
    walk_.revisit([&](const Observations& block) {
        refitAlbedo(block, estimate_.normals, estimate_.rig.lights, segmentation_.labels, tables, options_.bake.threads,
                    surface.albedo);
    });
    finishAlbedo(capture_, segmentation_.labels, tables, surface.albedo);
    return surface;
}

void quantise(Surface& surface, TexelFormat format)
{
    for (Material& material : surface.materials) {
        for (glm::vec3& value : material.table.values) {
            value = quantised(value, format);
        }
    }
}

} // namespace nacre
