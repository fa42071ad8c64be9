#include "acquisition/acquire.h"

#include <algorithm>
#include <chrono>

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

void storeNormals(const Observations& block, const std::vector<PixelNormal>& estimated, NormalMap& map, size_t& missing)
{
    for (size_t p = 0; p < block.pixels.size(); ++p) {
        map.normals[block.pixels[p]] = estimated[p].normal;
        map.confidence[block.pixels[p]] = estimated[p].confidence;
        missing += estimated[p].confidence <= 0;
    }
}

// Walks the capture block by block: normals of each block, then whatever else wants to see it.
using BlockVisitor = std::function<void(const Observations&, const std::vector<PixelNormal>&)>;

void walkCapture(const Capture& capture, const Rig& rig, const AcquireOptions& options, const Progress& progress,
                 StageClock& clock, NormalMap& map, size_t& missing, const BlockVisitor& visit)
{
    ObservationReader reader(capture, options.normals.threads, options.byteBudget);
    Observations block;
    size_t seen = 0;
    progress("reading", 0);
    while (clock.time("reading", [&] { return reader.next(block); })) {
        seen += block.pixels.size();
        progress("normals", static_cast<double>(seen) / static_cast<double>(capture.maskPixels));
        const std::vector<PixelNormal> normals =
            clock.time("normals", [&] { return estimateNormals(block, rig.lights, options.normals); });
        storeNormals(block, normals, map, missing);
        visit(block, normals);
    }
}

Surface surfaceOf(const Capture& capture, const Rig& rig, NormalMap normals, BakedBrdf baked)
{
    Surface surface = transferredSurface(normals, {capture.name, std::move(baked.table), std::move(baked.coverage)});
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
    result.rig = clock.time("lights", [&] { return calibrateLights(capture, options.calibration); });
    result.normals = NormalMap(capture.width, capture.height);
    walkCapture(capture, result.rig, options, progress, clock, result.normals, result.pixelsWithoutNormal,
                [](const Observations&, const std::vector<PixelNormal>&) {});
    return result;
}

Acquisition acquire(const Capture& capture, const AcquireOptions& options, const Progress& progress)
{
    Acquisition result;
    StageClock clock(result.times);
    progress("lights", 0);
    result.rig = clock.time("lights", [&] { return calibrateLights(capture, options.calibration); });
    NormalMap normals(capture.width, capture.height);
    BrdfSamples samples;
    samples.domain = capturedDomain(result.rig.lights, options.bake.coordinates);
    const double observations = static_cast<double>(capture.maskPixels) * static_cast<double>(result.rig.lights.size());
    const double share = static_cast<double>(options.samples.most) / std::max(observations, 1.0);
    walkCapture(capture, result.rig, options, progress, clock, normals, result.pixelsWithoutNormal,
                [&](const Observations& block, const std::vector<PixelNormal>& estimated) {
                    clock.time("samples", [&] {
                        gatherSamples(block, estimated, result.rig.lights, share, options.samples, samples,
                                      result.samples);
                    });
                });
    progress("baking", 0);
    BakedBrdf baked = clock.time("baking", [&] { return bakeBrdf(samples, options.regression, options.bake); });
    result.surface = surfaceOf(capture, result.rig, std::move(normals), std::move(baked));
    return result;
}

} // namespace nacre
