#include "acquisition/chain/normal_estimation.h"

#include "acquisition/chain/material_normals.h"
#include "acquisition/checks/height_consistency.h"
#include "acquisition/exemplar/normal_method.h"
#include "acquisition/normals/pixel_sample.h"
#include "acquisition/normals/smooth_fill.h"

namespace nacre {

namespace {

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

std::vector<std::string> namesOf(const std::vector<Photograph>& photographs)
{
    std::vector<std::string> names;
    for (const Photograph& photograph : photographs) {
        names.push_back(photograph.name);
    }
    return names;
}

// All lights are calibrated before any is chosen, so that irradiances do not depend on the choice.
Capture calibrateAndChoose(const Capture& capture, const AcquireOptions& options, NormalEstimate& result)
{
    const Rig rig = calibrateLights(capture, options.calibration);
    result.given = chosenLights(rig.lights, options.lights);
    result.rig = selectLights(rig, result.given);
    requireSpanningLights(result.rig.lights, capture.folder);
    return selectPhotographs(capture, result.given);
}

bool areIrradiancesKnown(const Capture& capture)
{
    return capture.irradianceGiven || capture.diffuseSphere.has_value();
}

// Takes over what was found out, and which photographs are left.
void keepPrepared(const Capture& capture, const PreparedNormals& prepared, NormalEstimate& result)
{
    for (size_t i = 0, next = 0; i < capture.photographs.size(); ++i) {
        if (next < prepared.agreeing.size() && prepared.agreeing[next] == i) {
            ++next;
        } else {
            result.leftOut.push_back(capture.photographs[i].name);
        }
    }
    std::vector<size_t> given;
    for (const size_t i : prepared.agreeing) {
        given.push_back(result.given[i]);
    }
    result.given = given;
    result.rig = selectLights(result.rig, prepared.agreeing);
    result.rig.lights = prepared.lights;
    result.report = prepared.report;
}

void addRemarks(const std::vector<std::string>& remarks, NormalReport& report)
{
    report.remarks.insert(report.remarks.end(), remarks.begin(), remarks.end());
}

// No normals, so no samples, from pixels that are to be smoothed over.
void dropMarked(const Capture& capture, const Observations& block, NormalBlock& normals)
{
    for (size_t p = 0; p < block.pixels.size() && !capture.smooth.empty(); ++p) {
        if (capture.smooth[block.pixels[p]]) {
            normals.pixels[p] = PixelNormal{};
        }
    }
}

void smoothMarked(const Capture& capture, NormalEstimate& result)
{
    if (!capture.smooth.empty()) {
        result.pixelsSmoothed = fillSmoothly(result.normals, capture.smooth, capture.mask);
        result.pixelsWithoutNormal -= result.pixelsSmoothed;
    }
}

} // namespace

CaptureWalk::CaptureWalk(const Capture& capture, const AcquireOptions& options, const Progress& progress,
                         NormalEstimate& result)
    : options_(options), progress_(progress), result_(result), clock_(result.times)
{
    progress("lights", 0);
    given_ = clock_.time("lights", [&] { return calibrateAndChoose(capture, options, result); });
}

void CaptureWalk::prepare(const Observations& first)
{
    CaptureSample sample{samplePixels(given_, first, options_.normals.threads, options_.byteBudget),
                         namesOf(given_.photographs), areIrradiancesKnown(given_), result_.rig.lights, given_.width};
    prepared_ = preparePhotographs(sample, options_);
    sample_ = std::move(sample.seen);
    keepPrepared(given_, prepared_, result_);
}

void CaptureWalk::makeEstimators()
{
    result_.report = prepared_.report;
    const std::vector<Light>& lights = prepared_.lights;
    if (!materials_) {
        NormalOptions options = options_.normals;
        options.method = NormalMethod::consensus;
        estimators_ = {makeNormalEstimator(intensitiesOf(sample_, lights), lights, options, result_.report)};
        return;
    }
    estimators_ = estimatorsByMaterial(sample_, *materials_, lights, options_.normals, result_.report);
    if (estimators_.size() == 1) { // a material's estimator knows nothing of the others
        addRemarks(methodWarnings(prepared_.checked, result_.report.method, estimators_.front()), result_.report);
    }
}

NormalBlock CaptureWalk::normalsOf(const Observations& block)
{
    NormalBlock normals = clock_.time("normals", [&] {
        return estimators_.size() == 1 ? estimateBlock(estimators_[0], block, prepared_.lights)
                                       : estimateByMaterial(estimators_, *materials_, block, prepared_.lights);
    });
    dropMarked(given_, block, normals);
    return normals;
}

void CaptureWalk::eachBlock(ObservationReader& reader, Observations& block, bool more,
                            const std::function<void(const Observations&)>& visit)
{
    for (size_t seen = 0; more; more = clock_.time("reading", [&] { return reader.next(block); })) {
        progress_("normals", static_cast<double>(seen) / static_cast<double>(given_.maskPixels));
        seen += block.pixels.size();
        if (prepared_.agreeing.size() < block.lightCount) {
            block = selectLights(block, prepared_.agreeing);
        }
        visit(block);
    }
}

// Estimators are made once the first block has shown the photographs.
void CaptureWalk::walkFiles(const std::function<void(const Observations&)>& visit)
{
    ObservationReader reader(given_, options_.normals.threads, options_.byteBudget);
    Observations block;
    progress_("reading", 0);
    const bool more = clock_.time("reading", [&] { return reader.next(block); });
    if (sample_.pixels.empty()) {
        progress_("choosing", 0);
        clock_.time("choosing", [&] { prepare(block); });
    }
    clock_.time("choosing", [&] { makeEstimators(); });
    eachBlock(reader, block, more, [&](const Observations& seen) {
        visit(seen);
        if (seen.pixels.size() == given_.maskPixels) {
            whole_ = seen;
        }
    });
}

void CaptureWalk::walk(const Visitor& visit)
{
    const auto show = [&](const Observations& block) { visit(block, normalsOf(block)); };
    if (whole_.pixels.empty()) {
        walkFiles(show);
        return;
    }
    progress_("choosing", 0);
    clock_.time("choosing", [&] { makeEstimators(); });
    show(whole_);
}

void CaptureWalk::survey(const Visitor& visit)
{
    materials_ = nullptr;
    walk(visit);
}

void CaptureWalk::estimate(const Segmentation& materials, const Visitor& visit)
{
    materials_ = &materials;
    result_.normals = NormalMap(given_.width, given_.height);
    walk([&](const Observations& block, const NormalBlock& normals) {
        result_.verdicts.resize(block.lightCount);
        storeNormals(block, normals, options_.keepVerdicts, result_);
        visit(block, normals);
    });
    addRemarks(heightWarnings(result_.normals), result_.report);
    smoothMarked(given_, result_);
}

void CaptureWalk::revisit(const std::function<void(const Observations&)>& visit)
{
    if (!whole_.pixels.empty()) {
        visit(whole_);
        return;
    }
    ObservationReader reader(given_, options_.normals.threads, options_.byteBudget);
    Observations block;
    const bool more = clock_.time("reading", [&] { return reader.next(block); });
    eachBlock(reader, block, more, visit);
}

NormalEstimate estimateCaptureNormals(const Capture& capture, const AcquireOptions& options, const Progress& progress)
{
    NormalEstimate result;
    const Segmentation whole = oneMaterial(capture);
    CaptureWalk(capture, options, progress, result).estimate(whole, [](const Observations&, const NormalBlock&) {});
    return result;
}

} // namespace nacre
