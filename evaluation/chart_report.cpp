#include "evaluation/chart_report.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "evaluation/chart_default.h"
#include "evaluation/chart_marks.h"

namespace nacre {

namespace {

std::string fieldOf(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos) {
        return text;
    }
    std::string quoted = "\"";
    for (const char c : text) {
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    }
    return quoted + "\"";
}

template <class Row> std::vector<Row> ofCapture(const std::vector<Row>& rows, const std::string& capture)
{
    std::vector<Row> found;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(found),
                 [&](const Row& row) { return row.capture == capture; });
    return found;
}

template <class Row> std::vector<std::string> capturesOf(const std::vector<Row>& rows)
{
    std::vector<std::string> names;
    for (const Row& row : rows) {
        if (std::find(names.begin(), names.end(), row.capture) == names.end()) {
            names.push_back(row.capture);
        }
    }
    return names;
}

// Letters and digits of a name, for a file.
std::string fileName(const std::string& capture, const std::string& what, std::set<std::string>& taken)
{
    std::string base;
    for (const char c : capture) {
        base += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    }
    std::string name = base + "-" + what + ".svg";
    for (int i = 2; !taken.insert(name).second; ++i) {
        name = fmt::format("{}-{}-{}.svg", base, what, i);
    }
    return name;
}

double orNan(bool known, double value)
{
    return known ? value : std::nan("");
}

Chart normalChart(const std::string& capture, const std::vector<NormalRow>& rows)
{
    const bool truth = rows.front().hasTruth;
    Chart chart{capture + ": normals, error against time",
                {"seconds from observations to normals", true, true},
                {truth ? "mean angular error, degrees" : "PSNR of held-out photographs, dB", truth, truth},
                {}};
    for (const NormalRow& row : rows) {
        chart.points.push_back({nameOf(row.setting.method), describe(row), row.seconds,
                                orNan(row.refusal.empty(), truth ? row.error.mean : row.psnr), isDefault(row.setting)});
    }
    return chart;
}

// Formats take no time of their own: against time, tables of full precision stand for all.
Chart brdfChart(const std::string& capture, const std::vector<BrdfRow>& rows, bool againstBytes)
{
    Chart chart{capture + (againstBytes ? ": BRDF, held-out photographs against bytes"
                                        : ": BRDF, held-out photographs against baking time"),
                {againstBytes ? "bytes of the tables" : "seconds from samples to tables", true, true},
                {"PSNR of held-out photographs, dB", false, false},
                {}};
    for (const BrdfRow& row : rows) {
        const bool shown = againstBytes || row.setting.format == TexelFormat::rgba32f;
        chart.points.push_back({nameOf(row.setting.interpolation), describe(row),
                                againstBytes ? static_cast<double>(row.bytes) : row.seconds, orNan(shown, row.psnr),
                                isDefault(row.setting)});
    }
    return chart;
}

std::string tableRow(const std::vector<std::string>& cells, bool front, bool usual)
{
    std::string html = fmt::format("<tr class=\"{}\">", usual ? "default" : front ? "front" : "");
    for (const std::string& cell : cells) {
        html += "<td>" + escaped(cell) + "</td>";
    }
    return html + "</tr>\n";
}

std::string tableOf(const std::vector<std::string>& heads, const std::string& body, size_t rows)
{
    std::string html = fmt::format("<details><summary>{} settings</summary><div class=\"wide\"><table><tr>", rows);
    for (const std::string& head : heads) {
        html += "<th>" + head + "</th>";
    }
    return html + "</tr>\n" + body + "</table></div></details>\n";
}

std::string normalTable(const std::vector<NormalRow>& rows, const std::vector<char>& front)
{
    std::string body;
    for (size_t i = 0; i < rows.size(); ++i) {
        const NormalRow& r = rows[i];
        const std::string error = !r.refusal.empty() ? r.refusal
                                  : r.hasTruth       ? fmt::format("{:.2f} degrees", r.error.mean)
                                                     : fmt::format("{:.2f} dB", r.psnr);
        body += tableRow({nameOf(r.setting.method), std::to_string(r.photographs), fmt::format("{:.2f}", r.seconds),
                          error, front[i] ? "yes" : ""},
                         front[i], isDefault(r.setting));
    }
    return tableOf({"method", "lights", "seconds", "error", "on the front"}, body, rows.size());
}

std::string brdfTable(const std::vector<BrdfRow>& rows, const std::vector<char>& bytes,
                      const std::vector<char>& seconds)
{
    std::string body;
    for (size_t i = 0; i < rows.size(); ++i) {
        const BrdfRow& r = rows[i];
        body += tableRow({nameOf(r.setting.interpolation), std::to_string(r.setting.k),
                          fmt::format("{}x{}x{}", r.size.x, r.size.y, r.size.z), nameOf(r.setting.format),
                          std::to_string(r.bytes), fmt::format("{:.2f}", r.seconds), fmt::format("{:.2f}", r.psnr),
                          bytes[i] && seconds[i] ? "both"
                          : bytes[i]             ? "bytes"
                          : seconds[i]           ? "time"
                                                 : ""},
                         bytes[i] || seconds[i], isDefault(r.setting));
    }
    return tableOf({"interpolation", "k", "table", "format", "bytes", "seconds", "PSNR, dB", "on the front of"}, body,
                   rows.size());
}

std::string section(const Chart& chart)
{
    return svgOf(chart) + "<p>" + escaped(describeDefault(chart)) + "</p>\n";
}

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>Nacre: speed against accuracy</title>
<style>
body { font: 16px/1.5 sans-serif; color: #222; max-width: 60rem; margin: 0 auto; padding: 1rem; }
svg { width: 100%; height: auto; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.85rem; font-variant-numeric: tabular-nums; }
th, td { padding: 0.15rem 0.7rem; text-align: left; border-bottom: 1px solid #ddd; }
tr.front td { color: #0072b2; }
tr.default td { color: #d55e00; font-weight: bold; }
</style></head><body>
<h1>Speed against accuracy</h1>
)";

} // namespace

std::string csvOf(const std::vector<NormalRow>& rows)
{
    std::string text = "capture,method,lights_given,seconds,mean_degrees,median_degrees,percentile95_degrees,"
                       "missing_pixels,held_out_psnr_decibels,is_default,refusal\n";
    for (const NormalRow& r : rows) {
        const bool done = r.refusal.empty();
        text += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", fieldOf(r.capture), nameOf(r.setting.method),
                            r.photographs, done ? fmt::format("{:.4f}", r.seconds) : "",
                            done && r.hasTruth ? fmt::format("{:.4f}", r.error.mean) : "",
                            done && r.hasTruth ? fmt::format("{:.4f}", r.error.median) : "",
                            done && r.hasTruth ? fmt::format("{:.4f}", r.error.percentile95) : "",
                            done && r.hasTruth ? std::to_string(r.error.missing) : "",
                            done && !r.hasTruth ? fmt::format("{:.4f}", r.psnr) : "",
                            isDefault(r.setting) ? "yes" : "no", fieldOf(r.refusal));
    }
    return text;
}

std::string csvOf(const std::vector<BrdfRow>& rows)
{
    std::string text = "capture,interpolation,k,texels_x,texels_y,texels_z,format,bytes,bake_seconds,"
                       "held_out_psnr_decibels,is_default\n";
    for (const BrdfRow& r : rows) {
        text += fmt::format("{},{},{},{},{},{},{},{},{:.4f},{:.4f},{}\n", fieldOf(r.capture),
                            nameOf(r.setting.interpolation), r.setting.k, r.size.x, r.size.y, r.size.z,
                            nameOf(r.setting.format), r.bytes, r.seconds, r.psnr, isDefault(r.setting) ? "yes" : "no");
    }
    return text;
}

std::vector<NamedChart> chartsOf(const ChartRows& rows)
{
    std::vector<NamedChart> charts;
    std::set<std::string> taken;
    for (const std::string& capture : capturesOf(rows.normals)) {
        charts.push_back({fileName(capture, "normals", taken), normalChart(capture, ofCapture(rows.normals, capture))});
    }
    for (const std::string& capture : capturesOf(rows.brdf)) {
        const std::vector<BrdfRow> own = ofCapture(rows.brdf, capture);
        charts.push_back({fileName(capture, "brdf-bytes", taken), brdfChart(capture, own, true)});
        charts.push_back({fileName(capture, "brdf-time", taken), brdfChart(capture, own, false)});
    }
    return charts;
}

std::string reportOf(const ChartRows& rows, const std::vector<std::string>& remarks)
{
    std::string html = kHead;
    for (const std::string& remark : remarks) {
        html += "<p>" + escaped(remark) + "</p>\n";
    }
    for (const std::string& capture : capturesOf(rows.normals)) {
        const std::vector<NormalRow> own = ofCapture(rows.normals, capture);
        const Chart chart = normalChart(capture, own);
        html += "<h2>" + escaped(chart.title) + "</h2>\n" + section(chart) + normalTable(own, frontOf(chart));
    }
    for (const std::string& capture : capturesOf(rows.brdf)) {
        const std::vector<BrdfRow> own = ofCapture(rows.brdf, capture);
        const Chart bytes = brdfChart(capture, own, true), seconds = brdfChart(capture, own, false);
        html += "<h2>" + escaped(capture) + ": BRDF</h2>\n" + section(bytes) + section(seconds) +
                brdfTable(own, frontOf(bytes), frontOf(seconds));
    }
    return html + "</body></html>\n";
}

} // namespace nacre
