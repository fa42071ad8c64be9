#include "evaluation/stress/stress.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/trigonometric.hpp>

#include "engine/files/error.h"
#include "engine/files/stopwatch.h"
#include "evaluation/stress/stress_brdf.h"
#include "evaluation/stress/stress_estimate.h"

namespace nacre {

namespace {

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

// What every method makes of one setting.
std::vector<StressRow> rowsOf(const StressSubject& subject, const PhotographedObject& object,
                              const PhotographedObject& undegraded, const std::vector<NormalMethod>& methods,
                              const AcquireOptions& options)
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
    for (StressRow& row : rows) {
        row.capture = subject.clean.name;
    }
    return rows;
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
            const PhotographedObject object = setting.photographed();
            const PhotographedObject& undegraded = setting.isOtherMaterial ? object : subject.clean;
            for (StressRow& row : rowsOf(subject, object, undegraded, methods, options)) {
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
