#include "evaluation/stress_tables.h"

#include <algorithm>

#include <fmt/format.h>

namespace nacre {

namespace {

constexpr double kBadDegrees = 5;

std::string fieldOf(const std::string& text)
{
    if (text.find_first_of(",\"\n") == std::string::npos) {
        return text;
    }
    std::string quoted = "\"";
    for (const char c : text) {
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    }
    return quoted + "\"";
}

const char* textOf(Said said)
{
    return said == Said::refusal ? "refused" : said == Said::warning ? "yes" : "no";
}

// In the order in which they first appear.
std::vector<std::string> distinct(const std::vector<StressRow>& rows, std::string StressRow::*member)
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

// "12.3!" for a silent failure, "12.3w" where the program warned.
std::string cellOf(const StressRow& row)
{
    if (row.said == Said::refusal) {
        return "refused";
    }
    return fmt::format("{:.2f}{}", row.error.mean, isSilentFailure(row) ? "!" : row.said == Said::warning ? "w" : " ");
}

std::string lineOf(const std::string& first, const std::vector<std::string>& cells)
{
    std::string line = fmt::format("{:>14}", first);
    for (const std::string& cell : cells) {
        line += fmt::format(" {:>14}", cell);
    }
    return line + "\n";
}

std::string breakingCell(const std::vector<StressRow>& curve)
{
    const std::optional<size_t> broken = breakingPoint(curve);
    const bool silent = std::any_of(curve.begin(), curve.end(), isSilentFailure);
    return (broken ? curve[*broken].setting : "-") + (silent ? "!" : " ");
}

} // namespace

std::string csvOf(const std::vector<StressRow>& rows)
{
    std::string text = "capture,sweep,setting,unit,method,mean_degrees,median_degrees,percentile95_degrees,pixels,"
                       "missing_pixels,seconds,warned,mean_confidence,silent_share\n";
    for (const StressRow& r : rows) {
        text += fmt::format("{},{},{},{},{},{:.4f},{:.4f},{:.4f},{},{},{:.3f},{},{:.4f},{:.4f}\n", fieldOf(r.capture),
                            r.sweep, r.setting, fieldOf(r.unit), r.method, r.error.mean, r.error.median,
                            r.error.percentile95, r.error.pixels, r.error.missing, r.seconds, textOf(r.said),
                            r.meanConfidence, r.silentShare);
    }
    return text;
}

std::string tablesOf(const std::vector<StressRow>& rows)
{
    const std::vector<std::string> methods = distinct(rows, &StressRow::method);
    std::string text;
    for (const std::string& sweep : distinct(rows, &StressRow::sweep)) {
        const std::vector<StressRow> ofSweep = rowsWhere(rows, &StressRow::sweep, sweep);
        const std::string& unit = ofSweep.front().unit;
        text += fmt::format("{}{}\n{}", sweep, unit.empty() ? "" : ", " + unit, lineOf("", methods));
        for (const std::string& setting : distinct(ofSweep, &StressRow::setting)) {
            std::vector<std::string> cells;
            for (const StressRow& row : rowsWhere(ofSweep, &StressRow::setting, setting)) {
                cells.push_back(cellOf(row));
            }
            text += lineOf(setting, cells);
        }
        text += "\n";
    }
    return text + fmt::format("mean degrees; ! more than {:.0f} % of the pixels are off by over {:.0f} degrees, with "
                              "more than even confidence and no warning; w with a warning\n",
                              100 * kSilentShare, kWrongDegrees);
}

std::optional<size_t> breakingPoint(const std::vector<StressRow>& curve)
{
    for (size_t i = 1; i < curve.size(); ++i) {
        const double mildest = curve.front().error.mean, mean = curve[i].error.mean;
        if (mean >= 2 * mildest || (mildest <= kBadDegrees && mean > kBadDegrees)) {
            return i;
        }
    }
    return std::nullopt;
}

std::string breakingPointsOf(const std::vector<StressRow>& rows)
{
    const std::vector<std::string> methods = distinct(rows, &StressRow::method);
    std::string text = lineOf("breaks at", methods);
    for (const std::string& sweep : distinct(rows, &StressRow::sweep)) {
        const std::vector<StressRow> ofSweep = rowsWhere(rows, &StressRow::sweep, sweep);
        std::vector<std::string> cells;
        for (const std::string& method : methods) {
            cells.push_back(breakingCell(rowsWhere(ofSweep, &StressRow::method, method)));
        }
        text += lineOf(sweep, cells);
    }
    return text + "the first setting whose mean error is twice the mildest's or passes 5 degrees; ! a setting of the "
                  "sweep fails silently\n";
}

} // namespace nacre
