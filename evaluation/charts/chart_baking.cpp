#include "evaluation/charts/chart_baking.h"

#include "acquisition/chain/material_albedo.h"
#include "acquisition/segmentation/segmentation.h"
#include "engine/files/stopwatch.h"

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
      prepared_(prepareCapture(capture, options, clock_, progress)),
      found_(estimateAndSample(prepared_, capture, segmentation_, options, clock_, progress))
{
    surface_.normals = found_.estimate.normals;
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
    const std::vector<BrdfSamples>& samples = found_.gathered.samples;
    const Stopwatch watch;
    for (size_t i = 0; i < samples.size(); ++i) {
        BakeOptions bake = options_.bake;
        bake.size = chartTableSizes(tableSize(samples[i].domain))[setting.size];
        BakedBrdf baked = bakeBrdf(samples[i], interpolation, bake);
        surface.materials.push_back(
            {segmentation_.regions[i].name, std::move(baked.table), std::move(baked.coverage), {}});
    }
    seconds = watch.seconds();
    std::vector<BrdfTable*> tables;
    for (Material& material : surface.materials) {
        tables.push_back(&material.table);
    }
    surface.albedo = found_.gathered.albedo;
    while (const Observations* block = prepared_.blocks.next()) {
        refitAlbedo(*block, found_.estimate.normals, prepared_.rig.lights, segmentation_.labels, tables,
                    options_.bake.threads, surface.albedo);
    }
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
