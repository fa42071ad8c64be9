#include "evaluation/charts/chart_default.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace nacre {

namespace {

// What is to be small, on a linear scale.
double costOf(const ChartAxis& axis, double value)
{
    return axis.isLessBetter ? value : std::pow(10.0, -value / 20);
}

bool isClearlyLess(const ChartAxis& axis, double value, double usual)
{
    return costOf(axis, value) < (1 - kClearlyBetter) * costOf(axis, usual);
}

// The default's index, or none.
std::optional<size_t> findDefault(const Chart& chart, const std::vector<size_t>& contest)
{
    const auto found = std::find_if(contest.begin(), contest.end(), [&](size_t i) {
        return chart.points[i].isDefault && std::isfinite(chart.points[i].y);
    });
    return found == contest.end() ? std::nullopt : std::optional(*found);
}

std::vector<size_t> clearlyBetter(const Chart& chart, const std::vector<size_t>& contest)
{
    std::vector<size_t> better;
    const std::optional<size_t> usual = findDefault(chart, contest);
    for (size_t i = 0; usual && i < contest.size(); ++i) {
        const ChartPoint &point = chart.points[contest[i]], &reference = chart.points[*usual];
        if (isClearlyLess(chart.x, point.x, reference.x) && isClearlyLess(chart.y, point.y, reference.y)) {
            better.push_back(contest[i]);
        }
    }
    return better;
}

// Labels may name their series already.
std::string nameOf(const ChartPoint& point)
{
    return point.label.rfind(point.series, 0) == 0 ? point.label : point.series + ", " + point.label;
}

} // namespace

std::vector<size_t> clearlyBetter(const Chart& chart)
{
    std::vector<size_t> better;
    for (const std::vector<size_t>& contest : contestsOf(chart)) {
        const std::vector<size_t> own = clearlyBetter(chart, contest);
        better.insert(better.end(), own.begin(), own.end());
    }
    return better;
}

std::string describeDefault(const Chart& chart)
{
    std::string text;
    for (const std::vector<size_t>& contest : contestsOf(chart)) {
        const std::optional<size_t> usual = findDefault(chart, contest);
        if (!usual) {
            continue;
        }
        std::string names;
        for (const size_t i : clearlyBetter(chart, contest)) {
            names += (names.empty() ? "" : "; ") + nameOf(chart.points[i]);
        }
        text += fmt::format("{}The program's default ({}) is beaten by more than {:.0f} % in both by {}.",
                            text.empty() ? "" : " ", nameOf(chart.points[*usual]), 100 * kClearlyBetter,
                            names.empty() ? "no other setting" : names);
    }
    return text;
}

} // namespace nacre
