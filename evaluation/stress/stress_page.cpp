#include "evaluation/stress/stress_page.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "evaluation/charts/html_page.h"
#include "evaluation/stress/stress_tables.h"

namespace nacre {

namespace {

constexpr const char* kSweepPlot = R"(
at(i) = sum [j=1:words(settings)] (word(settings, j) eq strcol('setting') ? j : 0)
isShown(i) = strcol('sweep') eq sweep && strcol('error_unit') eq errorUnit && strcol('warned') ne 'refused' && \
             (i == 0 || strcol('method') eq word(methods, i))
errorIf(isWanted) = isWanted ? column('error') : NaN

stats table using (errorIf(isShown(0))) name 'S' nooutput
span = decades(S_min, S_max)
set logscale y
set yrange [S_min / 10**(0.08 * span):S_max * 10**(0.08 * span)]
set ytics ()
set for [d=floor(log10(S_min))-1:ceil(log10(S_max))] for [m in marks(span)] ytics add (short(m * 10.0**d) m * 10.0**d)
set xrange [0.5:words(settings) + 0.5]
set xtics ()
set for [j=1:words(settings)] xtics add (word(settings, j) j)
colour(i) = word('#0072b2 #e69f00 #009e73 #56b4e9 #cc79a7 #000000 #8c8c1e', (i - 1) % 7 + 1)
red = '#d00000'

plot for [i=1:words(methods)] table using (at(0)):(errorIf(isShown(i))) \
         with linespoints pt shape(i) lw 1.5 lc rgb colour(i) title word(methods, i), \
     for [i=1:words(methods)] table using (at(0)):(errorIf(isShown(i) && strcol('silent') eq 'yes')) \
         with points pt shape(i) lc rgb red notitle, \
     table using (at(0)):(errorIf(isShown(0) && strcol('warned') eq 'yes')) \
         with points pt 7 ps 0.35 lc rgb '#ffffff' notitle, \
     table using (at(0)):(errorIf(isShown(0) && strcol('breaking') eq 'yes')) \
         with points pt 6 ps 1.8 lw 2 lc rgb orange notitle, \
     table using (at(0)):(errorIf(isShown(0) && strcol('silent') eq 'yes')) \
         with points pt 2 ps 1.6 lw 2 lc rgb red notitle, \
     keyentry with points pt 6 ps 1.8 lw 2 lc rgb orange title 'breaks here', \
     keyentry with points pt 2 ps 1.6 lw 2 lc rgb red title 'silent failure', \
     keyentry with points pt 6 ps 0.9 lw 3 lc rgb '#555555' title 'the program warned'
)";

// Rows of one sweep, normals or BRDFs. None where all are refused.
void addPlot(const std::vector<StressRow>& rows, std::vector<Plot>& plots)
{
    const bool any = std::any_of(rows.begin(), rows.end(), [](const StressRow& row) {
        return row.said != Said::refusal && std::isfinite(row.error) && row.error > 0;
    });
    if (!any) {
        return;
    }
    const StressRow& first = rows.front();
    const std::string name = fmt::format("{}-{}", first.sweep, first.isBrdf ? "brdf" : "normals");
    const std::string title = fmt::format("{}: {}, {}", first.capture, first.sweep, first.isBrdf ? "BRDF" : "normals");
    plots.push_back({name, plotHead(name, title, 720, 480) +
                               fmt::format("\ntable = '{}'; sweep = '{}'; errorUnit = '{}'\nsettings = '{}'\n"
                                           "methods = '{}'\nset xlabel {}\nset ylabel '{}'\n",
                                           kStressTable, first.sweep, errorUnitOf(first),
                                           fmt::join(distinctOf(rows, &StressRow::setting), " "),
                                           fmt::join(distinctOf(rows, &StressRow::method), " "), quoted(first.unit),
                                           first.isBrdf ? "error, % of the radiance" : "mean error, degrees") +
                               kSweepPlot});
}

std::string countTable(const std::vector<StressRow>& rows)
{
    const auto line = [](const std::string& name, const StressCounts& c) {
        return tableRow({name, std::to_string(c.runs), std::to_string(c.broken), std::to_string(c.said),
                         std::to_string(c.silent), std::to_string(c.overconfident), std::to_string(c.falseAlarms),
                         std::to_string(c.mildestAlarms)});
    };
    std::string body;
    for (const std::string& method : distinctOf(rows, &StressRow::method)) {
        body += line(method, countsOf(rowsWhere(rows, &StressRow::method, method)));
    }
    return tableOf(
        {"method", "runs", "broken", "said", "silent", "overconfident", "warned unbroken", "at the mildest setting"},
        body + line("all", countsOf(rows)));
}

std::string breakingTable(const std::vector<StressRow>& rows)
{
    std::vector<std::string> heads{"breaks at"};
    const std::vector<std::string> methods = distinctOf(rows, &StressRow::method);
    heads.insert(heads.end(), methods.begin(), methods.end());
    std::string body;
    for (const std::string& sweep : distinctOf(rows, &StressRow::sweep)) {
        std::vector<std::string> cells{sweep};
        const std::vector<StressRow> ofSweep = rowsWhere(rows, &StressRow::sweep, sweep);
        for (const std::string& method : methods) {
            const std::vector<StressRow> curve = rowsWhere(ofSweep, &StressRow::method, method);
            const std::optional<size_t> broken = breakingPoint(curve);
            cells.push_back(broken ? curve[*broken].setting : "-");
        }
        body += tableRow(cells);
    }
    return tableOf(heads, body);
}

// What was said, each once.
std::string wordsOf(const std::vector<StressRow>& rows)
{
    std::string html;
    for (const std::string& words : distinctOf(rows, &StressRow::warnings)) {
        html += words.empty() ? "" : "<p>" + escaped(words) + "</p>\n";
    }
    return html;
}

} // namespace

std::vector<Plot> stressPlotsOf(const std::vector<StressRow>& rows)
{
    std::vector<Plot> plots;
    for (const std::string& sweep : distinctOf(rows, &StressRow::sweep)) {
        for (const bool isBrdf : {false, true}) {
            std::vector<StressRow> own = rowsWhere(rows, &StressRow::sweep, sweep);
            std::erase_if(own, [&](const StressRow& row) { return row.isBrdf != isBrdf; });
            addPlot(own, plots);
        }
    }
    return plots;
}

std::string stressPageOf(const std::vector<StressRow>& rows, const std::string& remark,
                         const std::filesystem::path& folder)
{
    std::string html =
        pageHead("Nacre: where methods fail", "Where methods fail") +
        fmt::format("<p>A run is broken where its error is twice that at the sweep's first setting; silent where the "
                    "program then said nothing; overconfident where it is not broken, but more than {:.0f} % of its "
                    "pixels are off by over {:.0f} degrees at more than even confidence and nothing was said.</p>\n",
                    100 * kWrongShare, kWrongDegrees) +
        (remark.empty() ? "" : "<p>" + escaped(remark) + "</p>\n") + countTable(rows) + breakingTable(rows);
    for (const Plot& plot : stressPlotsOf(rows)) {
        html += plotFigure(folder, plot);
    }
    return html + folded("what the program said", wordsOf(rows)) + kPageEnd;
}

} // namespace nacre
