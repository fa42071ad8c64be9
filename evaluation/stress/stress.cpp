#include "evaluation/stress/stress.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "acquisition/brdf/albedo_factor.h"
#include "acquisition/brdf/bake.h"
#include "acquisition/brdf/brdf_samples.h"
#include "acquisition/capture/capture_maps.h"
#include "acquisition/capture/observations.h"
#include "acquisition/chain/capture_preparation.h"
#include "acquisition/chain/chosen_method.h"
#include "acquisition/checks/height_consistency.h"
#include "acquisition/lights/lights.h"
#include "acquisition/normals/light_triples.h"
#include "engine/files/error.h"
#include "engine/files/stopwatch.h"
#include "engine/files/whole_file.h"
#include "evaluation/held_out/photographed_object.h"

namespace nacre {
namespace {

// An object's photographs after what does not depend on the method of normals.
struct StressPhotographs {
    ReconciledPhotographs reconciled;
    CheckedSample checked;
    Observations seen; // of the photographs in use
};

// The normals that the program finds, and what it warns of.
struct StressEstimate {
    NormalBlock block;
    std::vector<Finding> warnings;
};

NormalMap mapOf(const PhotographedObject& object, const NormalBlock& block)
{
    NormalMap map(object.width, object.height);
    for (size_t p = 0; p < block.pixels.size(); ++p) {
        map.normals[object.seen.pixels[p]] = block.pixels[p].normal;
        map.confidence[object.seen.pixels[p]] = block.pixels[p].confidence;
    }
    return map;
}

// Throws Error where the program refuses, as estimateNormals does.
StressPhotographs preparedPhotographs(const PhotographedObject& object, const AcquireOptions& options)
{
    requireSpanningLights(object.lights, object.name);
    StressPhotographs photographs;
    photographs.reconciled = reconcilePhotographs(
        {evenSample(object.seen), object.photographs, object.irradiancesKnown, object.lights}, options);
    const CaptureSample& sample = photographs.reconciled.sample;
    photographs.checked = checkCapture(sample.seen, sample.lights, options.normals);
    photographs.seen = selectLights(object.seen, photographs.reconciled.agreeing);
    return photographs;
}

// The chain as `nacre normals` runs it, from the photographs on.
StressEstimate estimateNormals(const PhotographedObject& object, const StressPhotographs& photographs,
                               const AcquireOptions& options)
{
    const CaptureSample& sample = photographs.reconciled.sample;
    const ChosenMethod chosen = chooseMethod(sample, photographs.checked, options.normals);
    StressEstimate estimate{estimateBlock(chosen.estimators.front(), photographs.seen, sample.lights), {}};
    if (const auto warning = sphereWarning(directionsOf(object.lights), object.shadingDirections)) {
        estimate.warnings.push_back({FindingCode::spheresDisagree, *warning});
    }
    append(estimate.warnings, checkHeight(mapOf(object, estimate.block)).findings);
    append(estimate.warnings, warningsOf(sample.lights));
    append(estimate.warnings, photographs.checked.checks.findings);
    append(estimate.warnings, chosen.findings);
    std::erase_if(estimate.warnings, [](const Finding& finding) { return !isWarning(finding.code); });
    return estimate;
}

struct BrdfError {
    double percent = 0;
    double meanConfidence = 0; // of the table, where it was asked
};

const glm::vec3 kView(0, 0, 1);
constexpr size_t kMostJudged = 1000; // pixels
constexpr float kLeastCosine = 0.1f; // as samples are taken
// Below this share of the pixel's bright level an observation is in a cast shadow, of which no BRDF knows.
constexpr float kLitShare = 0.25f;

BrdfTable bakedTable(const StressPhotographs& photographs, const NormalBlock& normals, const AcquireOptions& options)
{
    const std::vector<Light>& lights = photographs.reconciled.sample.lights;
    BrdfSamples samples;
    samples.domain = tableDomain(lights, options.bake.range, options.bake.coordinates.value_or(kHalfDifference));
    SampleCounts counts;
    gatherSamples(photographs.seen, normals, albedoFactors(photographs.seen, normals, lights), lights, 1,
                  options.samples, samples, counts);
    return bakeBrdf(samples, options.interpolation, options.bake).table;
}

struct ErrorSums {
    double missed = 0, seen = 0, confidence = 0, count = 0;
};

void addPixel(const BrdfTable& table, const glm::vec3& normal, std::span<const glm::vec3> radiance,
              const std::vector<Light>& lights, ErrorSums& sums)
{
    std::vector<float> observed, predicted;
    for (size_t i = 0; i < lights.size(); ++i) {
        const float nDotL = glm::dot(normal, lights[i].direction);
        const BrdfValue f = evaluateTable(table, normal, lights[i].direction, kView);
        const bool faces = nDotL > kLeastCosine;
        observed.push_back(greyOf(radiance[i] / lights[i].irradiance));
        predicted.push_back(faces ? nDotL * greyOf(f.value) : 0.0f);
        sums.confidence += faces ? f.confidence : 0.0f;
        sums.count += faces;
    }
    const float lit = kLitShare * brightLevel(observed);
    double products = 0, squares = 0;
    for (size_t i = 0; i < lights.size(); ++i) {
        predicted[i] = observed[i] > lit ? predicted[i] : 0.0f;
        products += predicted[i] * observed[i];
        squares += predicted[i] * predicted[i];
    }
    for (size_t i = 0; i < lights.size() && squares > 0; ++i) {
        if (predicted[i] > 0) {
            sums.missed += std::abs(products / squares * predicted[i] - observed[i]);
            sums.seen += observed[i];
        }
    }
}

// How far a material is from the truth that was photographed. It is sampled from the estimate and baked, and predicts
// the undegraded photographs under their true lights and with their true normals: the sum of |prediction - photograph|
// over that of the photographs, in percent. Lit observations count, and each pixel has the factor that suits it best,
// as its albedo is not the material's.
BrdfError brdfError(const StressPhotographs& photographs, const NormalBlock& normals,
                    const PhotographedObject& undegraded, const AcquireOptions& options)
{
    const BrdfTable table = bakedTable(photographs, normals, options);
    ErrorSums sums;
    const size_t pixels = undegraded.seen.pixels.size(), step = pixels / kMostJudged + 1;
    for (size_t p = 0; p < pixels; p += step) {
        if (undegraded.truth.confidence[p] > 0) {
            addPixel(table, undegraded.truth.normals[p], undegraded.seen.radianceOf(p), undegraded.lights, sums);
        }
    }
    return {100 * sums.missed / std::max(sums.seen, 1e-30), sums.confidence / std::max(1.0, sums.count)};
}

constexpr double kUsualError = 0.01; // of photographs
constexpr double kLeastBrdfConfidence = 0.5;

NormalMap rowOf(const NormalBlock& block)
{
    NormalMap row(static_cast<int>(block.pixels.size()), 1);
    for (size_t p = 0; p < block.pixels.size(); ++p) {
        const PixelNormal& pixel = block.pixels[p];
        row.normals[p] = pixel.confidence > 0 ? pixel.normal : glm::vec3(0);
        row.confidence[p] = pixel.confidence;
    }
    return row;
}

void judgeNormals(const NormalMap& normals, const NormalMap& truth, StressRow& row)
{
    const std::vector<uint8_t> everywhere(truth.normals.size(), 1);
    row.angles = angularError(normals, truth, everywhere);
    row.error = row.angles.mean;
    double confidence = 0;
    size_t wrong = 0;
    for (size_t p = 0; p < truth.normals.size(); ++p) {
        if (truth.confidence[p] > 0) {
            confidence += normals.confidence[p];
            wrong +=
                normals.confidence[p] > 0.5f && degreesBetween(normals.normals[p], truth.normals[p]) > kWrongDegrees;
        }
    }
    const double pixels = std::max(1.0, static_cast<double>(row.angles.pixels));
    row.meanConfidence = confidence / pixels;
    row.wrongShare = static_cast<double>(wrong) / pixels;
}

struct TimedEstimate {
    std::optional<StressEstimate> estimate; // empty: refused
    std::string refusal;
    double seconds = 0;
};

// Prepared once for all methods; empty where the program refuses.
struct Preparation {
    std::optional<StressPhotographs> photographs;
    std::string refusal;
};

Preparation prepare(const PhotographedObject& object, const AcquireOptions& options)
{
    try {
        return {preparedPhotographs(object, options), {}};
    } catch (const Error& error) {
        return {{}, error.what()};
    }
}

TimedEstimate timedEstimate(const PhotographedObject& object, const Preparation& preparation, NormalMethod method,
                            const AcquireOptions& options)
{
    AcquireOptions chosen = options;
    chosen.normals.method = method;
    TimedEstimate timed;
    timed.refusal = preparation.refusal;
    if (!preparation.photographs) {
        return timed;
    }
    const Stopwatch watch;
    try {
        timed.estimate = estimateNormals(object, *preparation.photographs, chosen);
    } catch (const Error& error) {
        timed.refusal = error.what();
    }
    timed.seconds = watch.seconds();
    return timed;
}

void keepWords(const TimedEstimate& timed, StressRow& row)
{
    if (!timed.estimate) {
        row.said = Said::refusal;
        row.warnings = timed.refusal;
        return;
    }
    row.said = timed.estimate->warnings.empty() ? Said::nothing : Said::warning;
    for (const Finding& warning : timed.estimate->warnings) {
        row.warnings += (row.warnings.empty() ? "" : "; ") + lineOf(warning);
    }
}

StressRow normalRow(const TimedEstimate& timed, const PhotographedObject& object, NormalMethod method)
{
    StressRow row;
    row.method = nameOf(method);
    row.seconds = timed.seconds;
    keepWords(timed, row);
    judgeNormals(timed.estimate ? rowOf(timed.estimate->block) : NormalMap(object.truth.width, 1), object.truth, row);
    return row;
}

StressRow brdfRow(const TimedEstimate& timed, const Preparation& preparation, const PhotographedObject& undegraded,
                  InterpolationMethod method, const AcquireOptions& options)
{
    StressRow row;
    row.method = "brdf-" + nameOf(method);
    row.isBrdf = true;
    keepWords(timed, row);
    row.error = 100;
    AcquireOptions chosen = options;
    chosen.interpolation.method = method;
    const Stopwatch watch;
    try {
        if (timed.estimate) {
            const BrdfError error = brdfError(*preparation.photographs, timed.estimate->block, undegraded, chosen);
            row.error = error.percent;
            row.meanConfidence = error.meanConfidence;
        }
    } catch (const Error& error) {
        row.said = Said::refusal;
        row.warnings = error.what();
    }
    if (row.said == Said::nothing && row.meanConfidence < kLeastBrdfConfidence) {
        row.said = Said::warning;
        row.warnings = "coverage: most of what is asked was not seen";
    }
    row.seconds = watch.seconds();
    return row;
}

// A map's pixels that the mask has, in a row.
NormalMap rowOf(const NormalMap& map, const std::vector<uint8_t>& mask)
{
    NormalMap row(static_cast<int>(std::count(mask.begin(), mask.end(), 1)), 1);
    size_t next = 0;
    for (size_t pixel = 0; pixel < mask.size(); ++pixel) {
        if (mask[pixel]) {
            row.normals[next] = map.normals[pixel];
            row.confidence[next++] = map.confidence[pixel];
        }
    }
    return row;
}

// The whole of `nacre normals`.
StressRow capturedRow(const Capture& capture, NormalMethod method, const AcquireOptions& options)
{
    AcquireOptions chosen = options;
    chosen.normals.method = method;
    chosen.estimateDistance = true;
    const NormalMap truth =
        rowOf(windowedNormals(loadTrueNormals(capture.truthNormals), capture, capture.truthNormals), capture.mask);
    StressRow row;
    row.method = nameOf(method);
    NormalMap normals(truth.width, 1);
    const Stopwatch watch;
    TimedEstimate said;
    try {
        const NormalEstimate estimate = estimateCaptureNormals(capture, chosen, [](const std::string&, double) {});
        normals = rowOf(estimate.normals, capture.mask);
        said.estimate = {{}, estimate.report.findings};
        std::erase_if(said.estimate->warnings, [](const Finding& finding) { return !isWarning(finding.code); });
    } catch (const Error& error) {
        said.refusal = error.what();
    }
    row.seconds = watch.seconds();
    keepWords(said, row);
    judgeNormals(normals, truth, row);
    return row;
}

std::vector<StressRow> capturedRows(const Sweep::Setting& setting, const std::vector<NormalMethod>& methods,
                                    const AcquireOptions& options)
{
    const TemporaryFolder folder;
    const Capture capture = setting.captured(folder.path() / "capture");
    std::vector<StressRow> rows;
    for (const NormalMethod method : methods) {
        rows.push_back(capturedRow(capture, method, options));
    }
    return rows;
}

// What every method makes of photographs in memory.
std::vector<StressRow> photographedRows(const PhotographedObject& object, const PhotographedObject& undegraded,
                                        const std::vector<NormalMethod>& methods, const AcquireOptions& options)
{
    std::vector<StressRow> rows;
    const Preparation preparation = prepare(object, options);
    for (const NormalMethod method : methods) {
        const TimedEstimate timed = timedEstimate(object, preparation, method, options);
        rows.push_back(normalRow(timed, object, method));
        if (method == NormalMethod::automatic) {
            rows.push_back(brdfRow(timed, preparation, undegraded, InterpolationMethod::localLinear, options));
            rows.push_back(brdfRow(timed, preparation, undegraded, InterpolationMethod::paper, options));
        }
    }
    return rows;
}

// What every method makes of one setting.
std::vector<StressRow> rowsOf(const StressSubject& subject, const Sweep::Setting& setting,
                              const std::vector<NormalMethod>& methods, const AcquireOptions& options)
{
    if (setting.captured) {
        return capturedRows(setting, methods, options);
    }
    const PhotographedObject object = setting.photographed();
    return photographedRows(object, setting.isOtherMaterial ? object : subject.clean, methods, options);
}

} // namespace

StressFloors floorsOf(const std::vector<Light>& lights)
{
    return {glm::degrees(std::atan(kUsualError * conditionOf(lights))), 100 * kLeastTolerance};
}

void judgeRows(std::vector<StressRow>& rows, const StressFloors& floors)
{
    for (StressRow& row : rows) {
        const auto mildest = std::find_if(rows.begin(), rows.end(), [&](const StressRow& other) {
            return other.capture == row.capture && other.sweep == row.sweep && other.method == row.method;
        });
        const double floor = row.isBrdf ? floors.percent : floors.degrees;
        row.broken = &*mildest != &row && row.error >= 2 * std::max(mildest->error, floor);
    }
}

StressRow measureNormals(const PhotographedObject& object, NormalMethod method, const AcquireOptions& options)
{
    return normalRow(timedEstimate(object, prepare(object, options), method, options), object, method);
}

std::vector<StressRow> runSweeps(const StressSubject& subject, const std::vector<Sweep>& sweeps,
                                 const std::vector<NormalMethod>& methods, const AcquireOptions& options,
                                 const Progress& progress)
{
    size_t settings = 0, done = 0;
    for (const Sweep& sweep : sweeps) {
        settings += sweep.settings.size();
    }
    std::vector<StressRow> rows;
    for (const Sweep& sweep : sweeps) {
        for (const Sweep::Setting& setting : sweep.settings) {
            progress(fmt::format("{} {}", sweep.name, setting.value),
                     static_cast<double>(done++) / static_cast<double>(settings));
            for (StressRow& row : rowsOf(subject, setting, methods, options)) {
                row.capture = subject.clean.name;
                row.sweep = sweep.name;
                row.setting = setting.value;
                row.unit = sweep.unit;
                rows.push_back(std::move(row));
            }
        }
    }
    judgeRows(rows, floorsOf(subject.clean.lights));
    return rows;
}

} // namespace nacre
