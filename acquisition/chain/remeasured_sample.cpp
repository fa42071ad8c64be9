#include "acquisition/chain/remeasured_sample.h"

#include <numeric>

#include "acquisition/chain/material_albedo.h"
#include "acquisition/chain/material_blocks.h"
#include "acquisition/chain/self_lit_choice.h"

namespace nacre {

namespace {

constexpr double kMostSamples = 40'000; // of f, as many as say the same of a coarse table

void hideLights(std::span<const size_t> without, Observations& sample)
{
    for (size_t p = 0; p < sample.pixels.size(); ++p) {
        for (const size_t light : without) {
            sample.saturated[p * sample.lightCount + light] = 1; // no estimator looks at what is clipped
        }
    }
}

struct RowOfPixels {
    NormalMap normals;
    Image albedo;
    std::vector<uint8_t> labels;
};

RowOfPixels rowOf(const Observations& sample, const NormalBlock& normals, const std::vector<glm::vec3>& factors,
                  const Segmentation& segmentation)
{
    const auto count = static_cast<int>(sample.pixels.size());
    RowOfPixels row{NormalMap(count, 1), Image(count, 1, 3), {}};
    for (int p = 0; p < count; ++p) {
        row.normals.normals[p] = normals.pixels[p].normal;
        row.normals.confidence[p] = normals.pixels[p].confidence;
        row.albedo.setRgb(p, 0, factors[p]);
        row.labels.push_back(segmentation.labels[sample.pixels[p]]);
    }
    return row;
}

std::vector<BrdfSamples> samplesOf(const Measurement& measurement, const Observations& sample,
                                   const NormalBlock& normals, const std::vector<glm::vec3>& factors)
{
    const LocalLights lights = measurement.prepared.localLights();
    const Segmentation& segmentation = measurement.segmentation;
    std::vector<BrdfSamples> samples(segmentation.regions.size());
    const auto label = [&](uint32_t pixel) -> size_t {
        return segmentation.inner[pixel] ? segmentation.labels[pixel] : kUnlabelled;
    };
    const auto observations = static_cast<double>(sample.pixels.size() * sample.lightCount);
    forEachMaterial(sample, normals, factors, samples.size(), label, [&](size_t material, const BlockPart& part) {
        SampleCounts counts;
        samples[material].domain = tableDomain(lights.reference(), measurement.options.bake.range,
                                               measurement.surface.materials[material].table.domain.coordinates);
        gatherSamples(part.seen, part.normals, part.albedo, lights, kMostSamples / observations,
                      measurement.options.samples, samples[material], counts);
    });
    return samples;
}

Material coarseMaterial(const BrdfSamples& samples, const InterpolationOptions& interpolation, BakeOptions options)
{
    options.size = coarseTableSize(samples.domain);
    BakedBrdf baked = bakeBrdf(samples, interpolation, options);
    return {"", std::move(baked.table), {}, {}};
}

} // namespace

Surface remeasured(const Measurement& measurement, Observations sample, std::span<const size_t> without)
{
    hideLights(without, sample);
    NormalBlock normals;
    std::vector<glm::vec3> factors;
    std::vector<BrdfSamples> samples;
    const auto measure = [&](const Observations& direct) {
        normals = estimateNormals(measurement.prepared, measurement.method, measurement.segmentation, direct);
        factors = albedoFactors(direct, normals, measurement.prepared.rig.lights);
        samples = samplesOf(measurement, direct, normals, factors);
    };
    forEachDirect(measurement.prepared, measurement.method, sample, measurement.prepared.threads, measure);
    RowOfPixels row = rowOf(sample, normals, factors, measurement.segmentation);
    Surface surface;
    std::vector<BrdfTable*> tables;
    surface.materials.resize(samples.size());
    for (size_t m = 0; m < samples.size(); ++m) {
        if (samples[m].size() > 0) {
            surface.materials[m] =
                coarseMaterial(samples[m], measurement.interpolations[m].options, measurement.options.bake);
        }
        tables.push_back(&surface.materials[m].table);
    }
    for (size_t p = 0; p < row.labels.size(); ++p) {
        const uint8_t label = row.labels[p];
        const bool isMeasured = label < samples.size() && samples[label].size() > 0 && row.normals.confidence[p] > 0;
        if (!isMeasured) {
            row.labels[p] = Surface::kNoMaterial;
            row.normals.confidence[p] = 0;
            row.normals.normals[p] = glm::vec3(0);
        }
    }
    for (const uint32_t pixel : sample.pixels) {
        if (!measurement.surface.places.empty()) {
            surface.places.push_back(measurement.surface.places[pixel]);
        }
    }
    const LocalLights own = measurement.prepared.localLights().ofPixels(sample.pixels);
    std::iota(sample.pixels.begin(), sample.pixels.end(), 0u);
    refitAlbedo(sample, row.normals, own, row.labels, tables, measurement.options.bake.threads, row.albedo);
    surface.normals = std::move(row.normals);
    surface.labels = std::move(row.labels);
    surface.albedo = std::move(row.albedo);
    surface.lights = measurement.surface.lights;
    surface.camera = measurement.surface.camera;
    return surface;
}

} // namespace nacre
