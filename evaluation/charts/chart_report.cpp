#include "evaluation/charts/chart_report.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "evaluation/charts/chart_default.h"
#include "evaluation/charts/chart_marks.h"
#include "evaluation/charts/html_page.h"

namespace nacre {

namespace {

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

std::string kindOf(bool front, bool usual)
{
    return usual ? "default" : front ? "front" : "";
}

// Which of two fronts a setting is on.
std::string frontsOf(bool first, const char* firstName, bool second, const char* secondName)
{
    return first && second ? "both" : first ? firstName : second ? secondName : "";
}

std::string foldedTable(const std::vector<std::string>& heads, const std::string& body, size_t rows)
{
    return folded(fmt::format("{} settings", rows), tableOf(heads, body));
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
                         kindOf(front[i], isDefault(r.setting)));
    }
    return foldedTable({"method", "lights", "seconds", "error", "on the front"}, body, rows.size());
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
                          frontsOf(bytes[i], "bytes", seconds[i], "time")},
                         kindOf(bytes[i] || seconds[i], isDefault(r.setting)));
    }
    return foldedTable({"interpolation", "k", "table", "format", "bytes", "seconds", "PSNR, dB", "on the front of"},
                       body, rows.size());
}

std::string renderingTable(const std::vector<RenderingRow>& rows, const std::vector<char>& steady,
                           const std::vector<char>& moved)
{
    std::string body;
    for (size_t i = 0; i < rows.size(); ++i) {
        const RenderingRow& r = rows[i];
        body += tableRow({describe(r.setting), std::to_string(r.lights), fmt::format("{:.2f}", r.steadyMs),
                          fmt::format("{:.2f}", r.movedMs), fmt::format("{:.2f}", r.psnr),
                          frontsOf(steady[i], "steady", moved[i], "moved")},
                         kindOf(steady[i] || moved[i], r.isDefault));
    }
    return foldedTable({"path", "lights", "steady, ms", "moved, ms", "PSNR, dB", "on the front of"}, body, rows.size());
}

std::string section(const Chart& chart)
{
    return "<div class=\"wide\">" + svgOf(chart) + "</div><p>" + escaped(describeDefault(chart)) + "</p>\n";
}

} // namespace

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
    for (const std::string& capture : capturesOf(rows.rendering)) {
        const std::vector<RenderingRow> own = ofCapture(rows.rendering, capture);
        charts.push_back({fileName(capture, "rendering-steady", taken), steadyFrameChart(capture, own)});
        charts.push_back({fileName(capture, "rendering-moved", taken), movedFrameChart(capture, own)});
    }
    return charts;
}

std::string reportOf(const ChartRows& rows, const std::vector<std::string>& remarks)
{
    std::string html = pageHead("Nacre: speed against accuracy", "Speed against accuracy");
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
    for (const std::string& capture : capturesOf(rows.rendering)) {
        const std::vector<RenderingRow> own = ofCapture(rows.rendering, capture);
        const Chart steady = steadyFrameChart(capture, own), moved = movedFrameChart(capture, own);
        html += "<h2>" + escaped(capture) + ": rendering</h2>\n" + section(steady) + section(moved) +
                renderingTable(own, frontOf(steady), frontOf(moved));
    }
    return html + kPageEnd;
}

} // namespace nacre
