#include "acquisition/acquire.h"

#include <algorithm>
#include <chrono>

#include "acquisition/brdf/albedo_factor.h"
#include "acquisition/normals/intensity_refinement.h"
#include "acquisition/normals/pixel_sample.h"

namespace nacre {

namespace {

// Wall-clock seconds per stage, in the order in which stages first ran.
class StageClock {
public:
    explicit StageClock(std::vector<StageTime>& times) : times_(times) {}

    template <class Work> auto time(const std::string& stage, Work&& work)
    {
        const auto start = std::chrono::steady_clock::now();
        struct AddOnExit {
            std::vector<StageTime>& times;
            std::string stage;
            std::chrono::steady_clock::time_point start;
            ~AddOnExit()
            {
                const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
                const auto found =
                    std::find_if(times.begin(), times.end(), [&](const StageTime& t) { return t.stage == stage; });
                (found == times.end() ? times.emplace_back(StageTime{stage, 0}) : *found).seconds += seconds;
            }
        } add{times_, stage, start};
        return work();
    }

private:
    std::vector<StageTime>& times_;
};

void storeNormals(const Observations& block, const NormalBlock& estimated, bool keepVerdicts, NormalEstimate& result)
{
    const size_t n = block.lightCount;
    for (size_t p = 0; p < block.pixels.size(); ++p) {
        const PixelNormal& pixel = estimated.pixels[p];
        result.normals.normals[block.pixels[p]] = pixel.confidence > 0 ? pixel.normal : glm::vec3(0);
        result.normals.confidence[block.pixels[p]] = pixel.confidence;
        result.pixelsWithoutNormal += pixel.confidence <= 0;
        for (size_t i = 0; i < n; ++i) {
            VerdictCounts& counts = result.verdicts[i];
            switch (estimated.verdicts[p * n + i]) {
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
        result.pixels.insert(result.pixels.end(), block.pixels.begin(), block.pixels.end());
        result.everyVerdict.insert(result.everyVerdict.end(), estimated.verdicts.begin(), estimated.verdicts.end());
    }
}

NormalBlock estimateBlock(const NormalEstimator& estimator, const Observations& block, const std::vector<Light>& lights)
{
    NormalBlock normals = estimator(intensitiesOf(block, lights));
    for (size_t i = 0; i < block.saturated.size(); ++i) {
        if (block.saturated[i]) {
            normals.verdicts[i] = Verdict::saturated;
        }
    }
    return normals;
}

std::vector<std::string> namesOf(const std::vector<Photograph>& photographs)
{
    std::vector<std::string> names;
    for (const Photograph& photograph : photographs) {
        names.push_back(photograph.name);
    }
    return names;
}

bool areIrradiancesKnown(const Capture& capture)
{
    return capture.irradianceGiven || capture.diffuseSphere.has_value();
}

// Walks the capture block by block: normals of each block, then whatever else wants to see it.
using BlockVisitor = std::function<void(const Observations&, const NormalBlock&)>;

void walkCapture(const Capture& capture, const AcquireOptions& options, const Progress& progress, StageClock& clock,
                 NormalEstimate& result, const BlockVisitor& visit)
{
    std::vector<Light>& lights = result.rig.lights;
    result.normals = NormalMap(capture.width, capture.height);
    result.verdicts.resize(lights.size());
    ObservationReader reader(capture, options.normals.threads, options.byteBudget);
    Observations block;
    progress("reading", 0);
    bool more = clock.time("reading", [&] { return reader.next(block); });
    progress("choosing", 0);
    const NormalEstimator estimator = clock.time("choosing", [&] {
        const Observations sample = samplePixels(capture, block, options.normals.threads, options.byteBudget);
        if (options.correctIntensities) {
            result.report.remarks = correctIntensities(sample, namesOf(capture.photographs),
                                                       areIrradiancesKnown(capture), options.normals, lights);
        }
        return makeNormalEstimator(intensitiesOf(sample, lights), lights, options.normals, result.report);
    });
    for (size_t seen = 0; more; more = clock.time("reading", [&] { return reader.next(block); })) {
        progress("normals", static_cast<double>(seen) / static_cast<double>(capture.maskPixels));
        const NormalBlock normals = clock.time("normals", [&] { return estimateBlock(estimator, block, lights); });
        storeNormals(block, normals, options.keepVerdicts, result);
        visit(block, normals);
        seen += block.pixels.size();
    }
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

void AcquireOptions::setThreads(int threads)
{
    calibration.threads = normals.threads = samples.threads = bake.threads = threads;
}

NormalEstimate estimateCaptureNormals(const Capture& capture, const AcquireOptions& options, const Progress& progress)
{
    NormalEstimate result;
    StageClock clock(result.times);
    progress("lights", 0);
    result.rig = clock.time("lights", [&] { return calibrateLights(capture, options.calibration); });
    walkCapture(capture, options, progress, clock, result, [](const Observations&, const NormalBlock&) {});
    return result;
}

Acquisition acquire(const Capture& capture, const AcquireOptions& options, const Progress& progress)
{
    Acquisition result;
    NormalEstimate& estimate = result.estimate;
    StageClock clock(estimate.times);
    progress("lights", 0);
    estimate.rig = clock.time("lights", [&] { return calibrateLights(capture, options.calibration); });
    const std::vector<Light>& lights = estimate.rig.lights;
    BrdfSamples samples;
    samples.domain = capturedDomain(lights, options.bake.coordinates);
    const double observations = static_cast<double>(capture.maskPixels) * static_cast<double>(lights.size());
    const double share = static_cast<double>(options.samples.most) / std::max(observations, 1.0);
    Image albedo(capture.width, capture.height, 3);
    const auto addBlock = [&](const Observations& block, const NormalBlock& normals) {
        const std::vector<glm::vec3> factors = albedoFactors(block, normals, lights);
        for (size_t p = 0; p < factors.size(); ++p) {
            const uint32_t pixel = block.pixels[p];
            albedo.setRgb(static_cast<int>(pixel % capture.width), static_cast<int>(pixel / capture.width), factors[p]);
        }
        gatherSamples(block, normals, factors, lights, share, options.samples, samples, result.samples);
    };
    walkCapture(capture, options, progress, clock, estimate,
                [&](const Observations& block, const NormalBlock& normals) {
                    clock.time("samples", [&] { addBlock(block, normals); });
                });
    progress("baking", 0);
    BakedBrdf baked = clock.time("baking", [&] { return bakeBrdf(samples, options.regression, options.bake); });
    result.surface = surfaceOf(capture, estimate.rig, std::move(estimate.normals), std::move(albedo), std::move(baked));
    return result;
}

} // namespace nacre
