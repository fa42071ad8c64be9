#include "app/report/scattered_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "acquisition/brdf/interpolation.h"
#include "app/report/brdf_report.h"

namespace nacre {
namespace {

bool isSteep(const LightView& d)
{
    return std::min(d.l.z, d.v.z) >= std::cos(glm::radians(kSteepDegrees));
}

BrdfComparison compareHeldOut(const CornellMeasurements& m, const BrdfInterpolant& interpolant, bool steepOnly)
{
    const auto isAsked = [&](size_t i) { return !isKeptOfFive(i) && (!steepOnly || isSteep(m.directions[i])); };
    const BrdfSamples heldOut = samplesOf(m, isAsked);
    std::vector<glm::vec3> predicted;
    for (const glm::vec3& unit : heldOut.unit) {
        predicted.push_back(interpolant(unit).value);
    }
    BrdfComparison comparison;
    if (!predicted.empty()) {
        comparison = compareValues(predicted, heldOut.values);
    }
    comparison.outOf = comparison.configurations;
    return comparison;
}

glm::vec3 largestOf(const CornellMeasurements& m)
{
    glm::vec3 most(0);
    for (const glm::vec3& f : m.values) {
        most = glm::max(most, f);
    }
    return most;
}

} // namespace

ScatteredReport examineScattered(const std::filesystem::path& file, int threads)
{
    ScatteredReport report{file, loadCornellMeasurements(file), 0, {}};
    const BrdfSamples given = samplesOf(report.measurements, isKeptOfFive);
    report.given = given.size();
    for (const InterpolationMethod method : {InterpolationMethod::localLinear, InterpolationMethod::paper}) {
        InterpolationOptions options;
        options.method = method;
        options.threads = threads;
        const BrdfInterpolant interpolant = makeInterpolant(given, options);
        report.predictions.push_back({nameOf(method), compareHeldOut(report.measurements, interpolant, false),
                                      compareHeldOut(report.measurements, interpolant, true)});
    }
    return report;
}

void print(const ScatteredReport& report)
{
    const CornellMeasurements& m = report.measurements;
    const glm::vec3 most = largestOf(m);
    fmt::print("material     {}: {}\nkind         scattered measurements (Cornell)\n", report.file.string(), m.name);
    fmt::print("samples      {} of {} wavelengths, {:g} to {:g} nm; {} outside of Rec. 709, clipped at 0\n",
               m.values.size(), m.wavelengths.size(), m.wavelengths.front(), m.wavelengths.back(), m.clipped);
    fmt::print("range        to {:.4g} {:.4g} {:.4g} 1/sr, D65, CIE 1931 observer, linear Rec. 709\n\n", most.x, most.y,
               most.z);
    fmt::print("{} samples interpolated, error on the other {} (relative, floor 1 % of their peak):\n", report.given,
               m.values.size() - report.given);
    fmt::print("{:<14} {:>27}   {:>27}\n", "", "all: PSNR, median, 95th",
               fmt::format("to {:g} degrees", kSteepDegrees));
    for (const ScatteredPrediction& p : report.predictions) {
        fmt::print("{:<14} {:>8.2f} dB {:>6.2f} % {:>6.1f} %   {:>8.2f} dB {:>6.2f} % {:>6.1f} %\n", p.method,
                   p.all.psnr, 100 * p.all.median, 100 * p.all.percentile95, p.steep.psnr, 100 * p.steep.median,
                   100 * p.steep.percentile95);
    }
}

nlohmann::json jsonOf(const ScatteredReport& report)
{
    const CornellMeasurements& m = report.measurements;
    nlohmann::json json = {
        {"material", m.name},   {"samples", m.values.size()},   {"wavelengths", m.wavelengths.size()},
        {"clipped", m.clipped}, {"interpolated", report.given}, {"heldOut", nlohmann::json::object()}};
    for (const ScatteredPrediction& p : report.predictions) {
        json["heldOut"][p.method] = {{"all", jsonOf(p.all)}, {"steep", jsonOf(p.steep)}};
    }
    return json;
}

} // namespace nacre
