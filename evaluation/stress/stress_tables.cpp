#include "evaluation/stress/stress_tables.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "evaluation/charts/chart_tables.h"

namespace nacre {

namespace {

const char* textOf(Said said)
{
    return said == Said::refusal ? "refused" : said == Said::warning ? "yes" : "no";
}

std::string cellOf(const StressRow& row)
{
    if (row.said == Said::refusal) {
        return "refused  ";
    }
    return fmt::format("{:.2f} {}{}", row.error, row.broken ? 'b' : ' ',
                       isSilentFailure(row)        ? '!'
                       : isOverconfident(row)      ? 'o'
                       : row.said == Said::warning ? 'w'
                                                   : ' ');
}

std::string lineOf(const std::string& first, const std::vector<std::string>& cells)
{
    std::string line = fmt::format("{:>14}", first);
    for (const std::string& cell : cells) {
        line += fmt::format(" {:>17}", cell);
    }
    return line + "\n";
}

std::string breakingCell(const std::vector<StressRow>& curve)
{
    const std::optional<size_t> broken = breakingPoint(curve);
    const bool silent = std::any_of(curve.begin(), curve.end(), isSilentFailure);
    return (broken ? curve[*broken].setting : "-") + (silent ? "!" : " ");
}

std::string countLine(const std::string& name, const StressCounts& counts)
{
    return lineOf(name, {std::to_string(counts.runs), std::to_string(counts.broken), std::to_string(counts.said),
                         std::to_string(counts.silent), std::to_string(counts.overconfident),
                         std::to_string(counts.falseAlarms), std::to_string(counts.mildestAlarms)});
}

} // namespace

std::vector<std::string> distinctOf(const std::vector<StressRow>& rows, std::string StressRow::*member)
{
    std::vector<std::string> values;
    for (const StressRow& row : rows) {
        if (std::find(values.begin(), values.end(), row.*member) == values.end()) {
            values.push_back(row.*member);
        }
    }
    return values;
}

std::vector<StressRow> rowsWhere(const std::vector<StressRow>& rows, std::string StressRow::*member,
                                 const std::string& value)
{
    std::vector<StressRow> found;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(found),
                 [&](const StressRow& row) { return row.*member == value; });
    return found;
}

const char* errorUnitOf(const StressRow& row)
{
    return row.isBrdf ? "percent" : "degrees";
}

std::string csvOf(const std::vector<StressRow>& rows)
{
    std::string text = "capture,sweep,setting,unit,method,error,error_unit,median_degrees,percentile95_degrees,pixels,"
                       "missing_pixels,seconds,broken,breaking,warned,silent,mean_confidence,wrong_share,warnings\n";
    std::set<std::string> brokenCurves;
    for (const StressRow& r : rows) {
        const bool isBreaking = r.broken && brokenCurves.insert(r.sweep + "," + r.method).second;
        text += fmt::format("{},{},{},{},{},{:.4f},{},{:.4f},{:.4f},{},{},{:.3f},{},{},{},{},{:.4f},{:.4f},{}\n",
                            csvField(r.capture), r.sweep, r.setting, csvField(r.unit), r.method, r.error,
                            errorUnitOf(r), r.angles.median, r.angles.percentile95, r.angles.pixels, r.angles.missing,
                            r.seconds, r.broken ? "yes" : "no", isBreaking ? "yes" : "no", textOf(r.said),
                            isSilentFailure(r) ? "yes" : "no", r.meanConfidence, r.wrongShare, csvField(r.warnings));
    }
    return text;
}

std::string tablesOf(const std::vector<StressRow>& rows)
{
    const std::vector<std::string> methods = distinctOf(rows, &StressRow::method);
    std::string text;
    for (const std::string& sweep : distinctOf(rows, &StressRow::sweep)) {
        const std::vector<StressRow> ofSweep = rowsWhere(rows, &StressRow::sweep, sweep);
        const std::string& unit = ofSweep.front().unit;
        text += fmt::format("{}{}\n{}", sweep, unit.empty() ? "" : ", " + unit, lineOf("", methods));
        for (const std::string& setting : distinctOf(ofSweep, &StressRow::setting)) {
            std::vector<std::string> cells;
            for (const StressRow& row : rowsWhere(ofSweep, &StressRow::setting, setting)) {
                cells.push_back(cellOf(row));
            }
            text += lineOf(setting, cells);
        }
        text += "\n";
    }
    return text +
           fmt::format("mean degrees, BRDFs % of the radiance; b broken: twice the first setting's error; w with "
                       "a warning; ! broken without one; o more than {:.0f} % of the pixels are off by over "
                       "{:.0f} degrees with more than even confidence and no warning\n",
                       100 * kWrongShare, kWrongDegrees);
}

std::optional<size_t> breakingPoint(const std::vector<StressRow>& curve)
{
    const auto broken = std::find_if(curve.begin(), curve.end(), [](const StressRow& row) { return row.broken; });
    return broken == curve.end() ? std::nullopt : std::optional(static_cast<size_t>(broken - curve.begin()));
}

std::string breakingPointsOf(const std::vector<StressRow>& rows)
{
    const std::vector<std::string> methods = distinctOf(rows, &StressRow::method);
    std::string text = lineOf("breaks at", methods);
    for (const std::string& sweep : distinctOf(rows, &StressRow::sweep)) {
        const std::vector<StressRow> ofSweep = rowsWhere(rows, &StressRow::sweep, sweep);
        std::vector<std::string> cells;
        for (const std::string& method : methods) {
            cells.push_back(breakingCell(rowsWhere(ofSweep, &StressRow::method, method)));
        }
        text += lineOf(sweep, cells);
    }
    return text + "the first setting that is broken; ! a setting of the sweep is broken without a warning\n";
}

StressCounts countsOf(const std::vector<StressRow>& rows)
{
    StressCounts counts;
    for (size_t i = 0; i < rows.size(); ++i) {
        const StressRow& row = rows[i];
        const bool isMildest =
            std::none_of(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(i), [&](const StressRow& earlier) {
                return earlier.sweep == row.sweep && earlier.method == row.method && earlier.capture == row.capture;
            });
        ++counts.runs;
        counts.broken += row.broken;
        counts.silent += isSilentFailure(row);
        counts.overconfident += isOverconfident(row);
        counts.said += row.broken && !isSilentFailure(row);
        counts.falseAlarms += isFalseAlarm(row);
        counts.mildestAlarms += isFalseAlarm(row) && isMildest;
    }
    return counts;
}

std::string countTableOf(const std::vector<StressRow>& rows)
{
    std::string text =
        lineOf("", {"runs", "broken", "said", "silent", "overconfident", "warned unbroken", "at the mildest"});
    for (const std::string& method : distinctOf(rows, &StressRow::method)) {
        text += countLine(method, countsOf(rowsWhere(rows, &StressRow::method, method)));
    }
    return text + countLine("all", countsOf(rows));
}

} // namespace nacre
