#include "evaluation/charts/chart_measurement.h"

#include <algorithm>

#include <fmt/format.h>

#include "acquisition/chain/material_albedo.h"
#include "acquisition/segmentation/segmentation.h"
#include "engine/files/error.h"
#include "engine/files/stopwatch.h"
#include "evaluation/held_out/held_out_measures.h"

namespace nacre {
namespace {

// A capture as far as its samples, from which tables are made again and again: what acquire() does after its normals.
class ChartBaking {
public:
    // All are referred to while this lives.
    ChartBaking(const Capture& capture, const AcquireOptions& options, const Progress& progress);

    // The surface with tables of full precision; `seconds`: from samples to tables, without the albedo factors.
    Surface bake(const BrdfSetting& setting, double& seconds);

private:
    const Capture& capture_;
    const AcquireOptions& options_;
    Segmentation segmentation_;
    StageClock clock_;
    PreparedCapture prepared_;
    NormalsAndSamples found_;
    Surface surface_; // without materials
};

Segmentation segmentationOfCapture(const Capture& capture)
{
    return capture.labelsFile.empty() ? oneMaterial(capture)
                                      : segmentationOf(loadLabelPicture(capture.labelsFile, capture), capture);
}

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
        refitAlbedo(*block, found_.estimate.normals, prepared_.localLights(), segmentation_.labels, tables,
                    options_.bake.threads, surface.albedo);
    }
    finishAlbedo(capture_, segmentation_.labels, found_.chosen.haveOneAlbedo, tables, surface.albedo);
    return surface;
}

// As a device reads it from texels of that format.
void quantise(Surface& surface, TexelFormat format)
{
    for (Material& material : surface.materials) {
        for (glm::vec3& value : material.table.values) {
            value = quantised(value, format);
        }
    }
}

const Progress kSilent = [](const std::string&, double) {};

size_t countGiven(const Capture& capture)
{
    const size_t all = capture.photographs.size();
    return all - (all + kChartHeldOutEvery - 1) / kChartHeldOutEvery;
}

// Reads the whole capture at once, whose peak counts.
JudgingPhotographs readHeldOut(const Capture& capture, const AcquireOptions& options)
{
    const Rig rig = calibrateLights(capture, options.calibration);
    const std::vector<size_t> chosen = heldOutIndices(capture.photographs.size(), {.heldOutEvery = kChartHeldOutEvery});
    JudgingPhotographs heldOut;
    ObservationReader(capture, options.normals.threads, ~size_t{0}).next(heldOut.seen);
    heldOut.peak = peakOf(heldOut.seen.radiance);
    heldOut.seen = selectLights(heldOut.seen, chosen);
    heldOut.lights = selectLights(rig.lights, chosen);
    return heldOut;
}

// The stages from observations to normals; files are read either way.
double normalSeconds(const NormalEstimate& estimate)
{
    double seconds = 0;
    for (const StageTime& time : estimate.times) {
        seconds += time.stage == "choosing" || time.stage == "normals" ? time.seconds : 0;
    }
    return seconds;
}

NormalRow measureNormalSetting(const Capture& capture, AcquireOptions options, const NormalSetting& setting,
                               const JudgingPhotographs& heldOut)
{
    NormalRow row;
    row.capture = capture.name;
    row.setting = setting;
    row.photographs = setting.lightsGiven > 0 ? setting.lightsGiven : countGiven(capture);
    row.hasTruth = !capture.truthNormals.empty();
    options.normals.method = setting.method;
    options.lights.given = setting.lightsGiven;
    options.estimateDistance = true;
    try {
        if (row.hasTruth) {
            const NormalEstimate estimate = estimateCaptureNormals(capture, options, kSilent);
            row.seconds = normalSeconds(estimate);
            row.error = errorAgainstTruth(capture, estimate.normals, capture.truthNormals);
        } else {
            const Acquisition acquisition = acquire(capture, options, kSilent);
            row.seconds = normalSeconds(acquisition.estimate);
            row.psnr = psnrOf(acquisition.surface, heldOut, options.normals.threads);
        }
    } catch (const Error& error) {
        row.refusal = error.what();
    }
    return row;
}

// One setting, by a surface that was baked for another format of the same table, or anew.
class TableMeasurement {
public:
    TableMeasurement(const Capture& capture, const AcquireOptions& options, const JudgingPhotographs& heldOut)
        : capture_(capture), options_(options), heldOut_(heldOut), baking_(capture, options, kSilent)
    {
    }

    BrdfRow measure(const BrdfSetting& setting)
    {
        BrdfSetting table = setting;
        table.format = TexelFormat::rgba32f;
        if (baked_.materials.empty() || table != bakedFor_) {
            baked_ = baking_.bake(table, seconds_);
            bakedFor_ = table;
        }
        Surface surface = baked_;
        quantise(surface, setting.format);
        BrdfRow row{capture_.name, setting, surface.materials.front().table.size, 0, seconds_, 0};
        for (const Material& material : surface.materials) {
            row.bytes += material.table.values.size() * bytesPerTexel(setting.format);
        }
        row.psnr = psnrOf(surface, heldOut_, options_.normals.threads);
        return row;
    }

private:
    const Capture& capture_;
    const AcquireOptions& options_;
    const JudgingPhotographs& heldOut_;
    ChartBaking baking_;
    Surface baked_;
    BrdfSetting bakedFor_;
    double seconds_ = 0;
};

} // namespace

void requireChartable(const Capture& capture)
{
    if (countGiven(capture) < kFewestLightsGiven) {
        throw Error(capture.folder, fmt::format("has {} photographs", capture.photographs.size()),
                    fmt::format("{} or more, one of them held out", kFewestLightsGiven + 1));
    }
    calibrateLights(capture);
}

size_t countSettings(const Capture& capture, const ChartChoices& choices)
{
    return (choices.normals ? normalSettings(choices, countGiven(capture)).size() : 0) +
           (choices.brdf ? brdfSettings(choices).size() : 0);
}

void measureSettings(const Capture& capture, const AcquireOptions& asked, const ChartChoices& choices,
                     const ChartObserver& observer, ChartRows& rows)
{
    AcquireOptions options = asked;
    options.lights.heldOutEvery = kChartHeldOutEvery;
    const JudgingPhotographs heldOut = readHeldOut(capture, options);
    const size_t all = countSettings(capture, choices);
    size_t done = 0;
    for (const NormalSetting& setting : normalSettings(choices, choices.normals ? countGiven(capture) : 0)) {
        if (observer.isStopped()) {
            return;
        }
        observer.progress("normals by " + nameOf(setting.method), done++, all);
        rows.normals.push_back(measureNormalSetting(capture, options, setting, heldOut));
    }
    if (!choices.brdf || observer.isStopped()) {
        return;
    }
    observer.progress("samples of the BRDF", done, all);
    TableMeasurement measurement(capture, options, heldOut);
    for (const BrdfSetting& setting : brdfSettings(choices)) {
        if (observer.isStopped()) {
            return;
        }
        observer.progress("tables by " + nameOf(setting.interpolation), done++, all);
        rows.brdf.push_back(measurement.measure(setting));
    }
}

} // namespace nacre
