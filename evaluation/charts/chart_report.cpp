#include "evaluation/charts/chart_report.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "evaluation/charts/chart_tables.h"
#include "evaluation/charts/html_page.h"

namespace nacre {

namespace {

// Settings of one capture: the front as steps through blue points, dominated points grey, a ring about the default.
// Labels lean into the corner that the front leaves empty, where they keep clear of each other.
constexpr const char* kSettingsPlot = R"(
pick(isWanted, name) = isWanted ? column(name) : NaN
inSeries(i) = isShown(0) && strcol(seriesColumn) eq word(series, i)
isOn(i) = isShown(0) && strcol(frontColumn) eq 'yes' && (i == 0 || inSeries(i))
isUsual(i) = isShown(0) && strcol('is_default') eq 'yes'

# Axes end beyond the points, with room for labels on the better side.
stats table every ::first::last using (pick(isShown(0), xColumn)):(pick(isShown(0), yColumn)) name 'S' nooutput
xSpan = decades(S_min_x, S_max_x)
set logscale x
set xrange [S_min_x / 10**(0.15 * xSpan):S_max_x * 10**(0.1 * xSpan)]
set xtics ()
set for [d=floor(log10(S_min_x))-1:ceil(log10(S_max_x))] for [m in marks(xSpan)] \
    xtics add (short(m * 10.0**d) m * 10.0**d)
if (isError) {
    ySpan = decades(S_min_y, S_max_y)
    set logscale y
    set yrange [S_min_y / 10**(0.3 * ySpan):S_max_y * 10**(0.06 * ySpan)]
    set ytics ()
    set for [d=floor(log10(S_min_y))-1:ceil(log10(S_max_y))] for [m in marks(ySpan)] \
        ytics add (short(m * 10.0**d) m * 10.0**d)
} else {
    ySpan = S_max_y - S_min_y < 0.5 ? 0.5 : S_max_y - S_min_y
    set yrange [S_min_y - 0.06 * ySpan:S_max_y + 0.3 * ySpan]
}
set xlabel xLabel.' (left is better)' offset 0,0.4
set ylabel yLabel.(isError ? ' (down is better)' : ' (up is better)')
fronts = isFrontPerSeries ? words(series) : 0

plot for [i=1:words(series)] table every ::first::last \
         using (pick(inSeries(i) && !isOn(0), xColumn)):(column(yColumn)) \
         with points pt shape(i) ps 0.8 lc rgb grey notitle, \
     for [i=(fronts > 0):fronts] table every ::first::last using (pick(isOn(i), xColumn)):(pick(isOn(i), yColumn)) \
         smooth unique with steps lc rgb '#80b9d9' notitle, \
     for [i=1:words(series)] table every ::first::last using (pick(isOn(i), xColumn)):(column(yColumn)) \
         with points pt shape(i) ps 0.8 lc rgb blue notitle, \
     table every ::first::last using (pick(isUsual(0), xColumn)):(column(yColumn)) \
         with points pt 6 ps 1.8 lw 2 lc rgb orange notitle, \
     table every ::first::last using (pick(isOn(0), xColumn)):(column(yColumn)):(label(0)) \
         with labels right rotate by (isError ? 45 : -45) offset character -0.6,(isError ? -0.6 : 0.6) \
         font ',9' notitle, \
     table every ::first::last using (pick(isUsual(0) && !isOn(0), xColumn)):(column(yColumn)):(label(0)) \
         with labels center offset character 0,(isError ? 1.3 : -1.3) font ',9' tc rgb orange notitle, \
     for [i=1:words(series)] keyentry with points pt shape(i) lc rgb '#555555' \
         title word(series, i).(word(series, i) eq '1' ? ' light' : seriesSuffix), \
     keyentry with points pt 6 ps 1.8 lw 2 lc rgb orange title "the program's default", \
     keyentry with points pt 7 lc rgb blue title 'no other setting beats it', \
     keyentry with points pt 7 lc rgb grey title 'dominated'
)";

// The columns of a table, as its csvOf names them, and gnuplot's words for a row's label and whether it is shown.
struct PlotColumns {
    const char* table;
    const char* series;
    const char* x;
    const char* y;
    const char* front;
    const char* label;
    const char* shown = "1";
};

constexpr const char* kNormalLabel = "strcol('method').', '.strcol('lights_given').' lights'";
constexpr PlotColumns kDegrees{kNormalTable, "method", "seconds", "mean_degrees", "on_front", kNormalLabel};
constexpr PlotColumns kDecibels{kNormalTable, "method", "seconds", "held_out_psnr_decibels", "on_front", kNormalLabel};
constexpr const char* kBrdfLabel = "'k '.strcol('k').', '.strcol('texels_x').'x'.strcol('texels_y').'x'."
                                   "strcol('texels_z').' '.strcol('format')";
constexpr PlotColumns kBytes{kBrdfTable,       "interpolation", "bytes", "held_out_psnr_decibels",
                             "on_bytes_front", kBrdfLabel};
constexpr PlotColumns kBaking{kBrdfTable,
                              "interpolation",
                              "bake_seconds",
                              "held_out_psnr_decibels",
                              "on_time_front",
                              kBrdfLabel,
                              "strcol('format') eq 'RGBA32F'"};
constexpr const char* kPathLabel = "strcol('path') eq 'direct' ? 'direct' : strcol('ball_texels') eq '0' ? 'ball auto' "
                                   ": 'ball '.strcol('ball_texels').'/'.strcol('ball_texels_shown')";
constexpr PlotColumns kSteady{kRenderingTable,         "lights",          "steady_frame_ms",
                              "picture_psnr_decibels", "on_steady_front", kPathLabel};
constexpr PlotColumns kMoved{kRenderingTable,         "lights",         "moved_lights_frame_ms",
                             "picture_psnr_decibels", "on_moved_front", kPathLabel};

// Names that are files' as well.
class PlotNames {
public:
    // Letters and digits of the capture's name.
    std::string next(const std::string& capture, const char* what)
    {
        std::string base;
        for (const char c : capture) {
            base += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
        }
        std::string name = base + "-" + what;
        for (int i = 2; !taken_.insert(name).second; ++i) {
            name = fmt::format("{}-{}-{}", base, what, i);
        }
        return name;
    }

private:
    std::set<std::string> taken_;
};

// Rows of the table from `first` on.
Plot plotOf(const std::string& name, const Chart& chart, const PlotColumns& columns, size_t first)
{
    // A series' name begins with its column's value.
    std::vector<std::string> series;
    std::string suffix;
    for (const ChartPoint& point : chart.points) {
        const size_t end = std::min(point.series.find(' '), point.series.size());
        if (std::find(series.begin(), series.end(), point.series.substr(0, end)) == series.end()) {
            series.push_back(point.series.substr(0, end));
            suffix = point.series.substr(end);
        }
    }
    return {name, plotHead(name, chart.title, 960, 700) +
                      fmt::format("\ntable = '{}'; first = {}; last = {} # its rows, below the heading\n"
                                  "series = '{}'; seriesColumn = '{}'; seriesSuffix = '{}'; isFrontPerSeries = {:d}\n"
                                  "xColumn = '{}'; xLabel = '{}'\nyColumn = '{}'; yLabel = '{}'; isError = {:d}\n"
                                  "frontColumn = '{}'\nisShown(i) = {}\nlabel(i) = {}\n",
                                  columns.table, first, first + chart.points.size() - 1, fmt::join(series, " "),
                                  columns.series, suffix, chart.isFrontPerSeries, columns.x, chart.xLabel, columns.y,
                                  chart.yLabel, chart.isError, columns.front, columns.shown, columns.label) +
                      kSettingsPlot};
}

// "default", "front" or neither: how a table's row looks.
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

std::string normalTable(std::span<const NormalRow> rows)
{
    const std::vector<char> front = frontOf(normalChart(rows));
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

std::string brdfTable(std::span<const BrdfRow> rows)
{
    const std::vector<char> bytes = frontOf(bytesChart(rows)), seconds = frontOf(bakingChart(rows));
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

std::string renderingTable(std::span<const RenderingRow> rows)
{
    const std::vector<char> steady = frontOf(steadyChart(rows)), moved = frontOf(movedChart(rows));
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

// A capture's part of the page: its charts and the table below them.
struct Section {
    std::string heading, table;
    std::vector<std::string> verdicts; // a chart's each
    std::vector<Plot> plots;           // a chart's each; without a script where nothing can be drawn
};

void addChart(Section& section, const std::string& name, const Chart& chart, const PlotColumns& columns, size_t first)
{
    const bool any = std::any_of(chart.points.begin(), chart.points.end(),
                                 [&](const ChartPoint& point) { return isDrawn(chart, point); });
    section.plots.push_back(any ? plotOf(name, chart, columns, first) : Plot{name, ""});
    section.verdicts.push_back(any ? describeDefault(chart) : "nothing was measured");
}

std::vector<Section> sectionsOf(const ChartRows& rows)
{
    PlotNames names;
    std::vector<Section> sections;
    for (const auto part : byCapture(rows.normals)) {
        const Chart chart = normalChart(part);
        Section& section = sections.emplace_back(Section{chart.title, normalTable(part), {}, {}});
        addChart(section, names.next(part.front().capture, "normals"), chart, chart.isError ? kDegrees : kDecibels,
                 part.data() - rows.normals.data());
    }
    for (const auto part : byCapture(rows.brdf)) {
        const std::string& capture = part.front().capture;
        const size_t first = part.data() - rows.brdf.data();
        Section& section = sections.emplace_back(Section{capture + ": BRDF", brdfTable(part), {}, {}});
        addChart(section, names.next(capture, "brdf-bytes"), bytesChart(part), kBytes, first);
        addChart(section, names.next(capture, "brdf-time"), bakingChart(part), kBaking, first);
    }
    for (const auto part : byCapture(rows.rendering)) {
        const std::string& capture = part.front().capture;
        const size_t first = part.data() - rows.rendering.data();
        Section& section = sections.emplace_back(Section{capture + ": rendering", renderingTable(part), {}, {}});
        addChart(section, names.next(capture, "rendering-steady"), steadyChart(part), kSteady, first);
        addChart(section, names.next(capture, "rendering-moved"), movedChart(part), kMoved, first);
    }
    return sections;
}

} // namespace

std::vector<Plot> plotsOf(const ChartRows& rows)
{
    std::vector<Plot> plots;
    for (const Section& section : sectionsOf(rows)) {
        std::copy_if(section.plots.begin(), section.plots.end(), std::back_inserter(plots),
                     [](const Plot& plot) { return !plot.script.empty(); });
    }
    return plots;
}

std::string reportOf(const ChartRows& rows, const std::vector<std::string>& remarks,
                     const std::filesystem::path& folder)
{
    std::string html = pageHead("Nacre: speed against accuracy", "Speed against accuracy");
    for (const std::string& remark : remarks) {
        html += "<p>" + escaped(remark) + "</p>\n";
    }
    for (const Section& section : sectionsOf(rows)) {
        html += "<h2>" + escaped(section.heading) + "</h2>\n";
        for (size_t i = 0; i < section.plots.size(); ++i) {
            html += plotFigure(folder, section.plots[i]) + "<p>" + escaped(section.verdicts[i]) + "</p>\n";
        }
        html += section.table;
    }
    return html + kPageEnd;
}

} // namespace nacre
