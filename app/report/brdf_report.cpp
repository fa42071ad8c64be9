#include "app/report/brdf_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "acquisition/brdf/interpolation.h"

namespace nacre {
namespace {

using Json = nlohmann::json;

Json jsonOf(const glm::vec3& v)
{
    return Json::array({v.x, v.y, v.z});
}

bool isNatural(const BrdfTable& table)
{
    return table.domain.coordinates == kNatural;
}

// Of those whose light and view are above the horizon.
template <class Counts> double shareOfTexels(const BrdfTable& table, const Counts& counts)
{
    size_t above = 0, counted = 0;
    for (int k = 0; k < table.size.z; ++k) {
        for (int j = 0; j < table.size.y; ++j) {
            for (int i = 0; i < table.size.x; ++i) {
                const LightView d = table.directions(i, j, k);
                if (d.l.z > 0 && d.v.z > 0) {
                    ++above;
                    counted += counts(table.index(i, j, k));
                }
            }
        }
    }
    return above == 0 ? 0 : static_cast<double>(counted) / static_cast<double>(above);
}

void printTable(const BrdfTable& table)
{
    constexpr double kMebibyte = 1024.0 * 1024.0;
    const double bytes = static_cast<double>(table.values.size()) * 4 * sizeof(float);
    fmt::print("table        {}x{}x{} texels, {:.1f} MiB as RGBA32F, {}\n", table.size.x, table.size.y, table.size.z,
               bytes / kMebibyte,
               isNatural(table)
                   ? "natural coordinates"
                   : fmt::format("{}, thetaD to {:.1f} degrees", nameOfCoordinates(table.domain.coordinates),
                                 glm::degrees(table.domain.thetaDMax)));
    fmt::print("covered      {:.1f} % of the texels whose light and view are above the horizon\n",
               100 * coveredShare(table));
    fmt::print("certain      {:.1f} % of them: expected to be off by at most {:.0f} %\n", 100 * certainShare(table),
               100 * kUncertainError);
}

void printAudit(const BrdfAudit& audit, bool relative)
{
    if (audit.configurations == 0) {
        fmt::print("audit        nothing is covered\n");
    } else {
        fmt::print("range        {:.4g} {:.4g} {:.4g} to {:.4g} {:.4g} {:.4g} {} over {} covered configurations\n",
                   audit.least.x, audit.least.y, audit.least.z, audit.most.x, audit.most.y, audit.most.z,
                   relative ? "(relative)" : "1/sr", audit.configurations);
        fmt::print("reciprocity  f(l,v) against f(v,l): median {:.2f} %, 95th percentile {:.2f} %, largest {:.1f} %\n",
                   100 * audit.reciprocityMedian, 100 * audit.reciprocity95, 100 * audit.reciprocityMost);
        fmt::print("positivity   {} below 0, {} no numbers\n", audit.negative, audit.notFinite);
    }
    fmt::print("\nwhite furnace{}\n  view from normal    reflected r g b    covered\n",
               relative ? " (relative scale: up to one factor)" : "");
    for (const DirectionalAlbedo& a : audit.albedos) {
        fmt::print("  {:>11.0f} deg    {:.3f} {:.3f} {:.3f}    {:>5.1f} %\n", a.thetaDegrees, a.albedo.x, a.albedo.y,
                   a.albedo.z, 100 * a.covered);
    }
    fmt::print("  largest            {:.3f}{}\n", audit.largestAlbedo,
               audit.largestAlbedo > 1 && !relative ? "  makes energy" : "");
}

} // namespace

double coveredShare(const BrdfTable& table)
{
    return shareOfTexels(table, [&](size_t texel) { return table.confidence[texel] >= kCoveredConfidence; });
}

double certainShare(const BrdfTable& table)
{
    return shareOfTexels(table, [&](size_t texel) { return expectedError(table, texel) <= kUncertainError; });
}

void print(const BrdfReport& report)
{
    fmt::print("material     {}\nkind         {}\n", report.source.name, report.source.kind);
    if (const BrdfTable* table = tableOf(report.source.model)) {
        printTable(*table);
    }
    printAudit(report.audit, report.source.relative);
    if (report.comparison) {
        const BrdfComparison& c = *report.comparison;
        fmt::print("\nagainst      {}\n", report.against);
        fmt::print("compared     {} of {} configurations, where both are covered\n", c.configurations, c.outOf);
        fmt::print("PSNR         {:.2f} dB\n", c.psnr);
        fmt::print("error        median {:.3f} %, 95th percentile {:.3f} % (relative, floor 1 % of the peak {:.4g})\n",
                   100 * c.median, 100 * c.percentile95, c.peak);
    }
}

nlohmann::json jsonOf(const BrdfComparison& c)
{
    return {// JSON knows no infinity: equal materials have null.
            {"psnr", std::isfinite(c.psnr) ? Json(c.psnr) : Json()},
            {"medianRelativeError", c.median},
            {"percentile95RelativeError", c.percentile95},
            {"peak", c.peak},
            {"configurations", c.configurations},
            {"outOf", c.outOf}};
}

nlohmann::json jsonOf(const BrdfReport& report)
{
    const BrdfAudit& audit = report.audit;
    Json json = {{"material", report.source.name},
                 {"kind", report.source.kind},
                 {"relative", report.source.relative},
                 {"configurations", audit.configurations},
                 {"least", jsonOf(audit.least)},
                 {"most", jsonOf(audit.most)},
                 {"reciprocity",
                  {{"median", audit.reciprocityMedian},
                   {"percentile95", audit.reciprocity95},
                   {"largest", audit.reciprocityMost}}},
                 {"negative", audit.negative},
                 {"notFinite", audit.notFinite},
                 {"furnace", Json::array()},
                 {"largestAlbedo", audit.largestAlbedo}};
    for (const DirectionalAlbedo& a : audit.albedos) {
        json["furnace"].push_back(
            {{"thetaDegrees", a.thetaDegrees}, {"albedo", jsonOf(a.albedo)}, {"covered", a.covered}});
    }
    if (const BrdfTable* table = tableOf(report.source.model)) {
        json["table"] = {{"size", {table->size.x, table->size.y, table->size.z}},
                         {"coordinates", nameOfCoordinates(table->domain.coordinates)},
                         {"thetaDMaxDegrees", glm::degrees(table->domain.thetaDMax)},
                         {"covered", coveredShare(*table)},
                         {"certain", certainShare(*table)}};
    }
    if (report.comparison) {
        json["against"] = jsonOf(*report.comparison);
        json["against"]["material"] = report.against;
    }
    return json;
}

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
