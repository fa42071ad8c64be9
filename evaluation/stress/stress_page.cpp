#include <fmt/format.h>

#include "evaluation/charts/chart_marks.h"
#include "evaluation/charts/html_page.h"
#include "evaluation/stress/stress_chart.h"
#include "evaluation/stress/stress_tables.h"

namespace nacre {

namespace {

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

std::string stressPageOf(const std::vector<StressRow>& rows)
{
    std::string html =
        pageHead("Nacre: where methods fail", "Where methods fail") +
        fmt::format("<p>A run is broken where its error is twice that at the sweep's first setting; silent where the "
                    "program then said nothing; overconfident where it is not broken, but more than {:.0f} % of its "
                    "pixels are off by over {:.0f} degrees at more than even confidence and nothing was said.</p>\n",
                    100 * kWrongShare, kWrongDegrees) +
        countTable(rows) + breakingTable(rows);
    for (const StressChart& chart : stressChartsOf(rows)) {
        html += chart.svg;
    }
    return html + folded("what the program said", wordsOf(rows)) + kPageEnd;
}

} // namespace nacre
