#include "app/report/brdf_report.h"

#include <cmath>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

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

void printTable(const BrdfTable& table)
{
    constexpr double kMebibyte = 1024.0 * 1024.0;
    const double bytes = static_cast<double>(table.values.size()) * 4 * sizeof(float);
    fmt::print("table        {}x{}x{} texels, {:.1f} MiB as RGBA32F, {}\n", table.size.x, table.size.y, table.size.z,
               bytes / kMebibyte,
               isNatural(table)
                   ? "natural coordinates"
                   : fmt::format("half-difference, thetaD to {:.1f} degrees", glm::degrees(table.domain.thetaDMax)));
    fmt::print("covered      {:.1f} % of the texels whose light and view are above the horizon\n",
               100 * coveredShare(table));
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
    size_t above = 0, covered = 0;
    for (int k = 0; k < table.size.z; ++k) {
        for (int j = 0; j < table.size.y; ++j) {
            for (int i = 0; i < table.size.x; ++i) {
                const LightView d = table.directions(i, j, k);
                if (d.l.z > 0 && d.v.z > 0) {
                    ++above;
                    covered += table.confidence[table.index(i, j, k)] >= kCoveredConfidence;
                }
            }
        }
    }
    return above == 0 ? 0 : static_cast<double>(covered) / static_cast<double>(above);
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
                         {"coordinates", isNatural(*table) ? "natural" : "half-difference"},
                         {"thetaDMaxDegrees", glm::degrees(table->domain.thetaDMax)},
                         {"covered", coveredShare(*table)}};
    }
    if (report.comparison) {
        json["against"] = jsonOf(*report.comparison);
        json["against"]["material"] = report.against;
    }
    return json;
}

} // namespace nacre
