#include "evaluation/charts/chart.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace nacre {

namespace {

// The points that compete with each other, as indices.
std::vector<std::vector<size_t>> contestsOf(const Chart& chart)
{
    std::vector<std::string> names;
    std::vector<std::vector<size_t>> contests;
    for (size_t i = 0; i < chart.points.size(); ++i) {
        const std::string name = chart.isFrontPerSeries ? chart.points[i].series : "";
        const size_t at = static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin());
        if (at == names.size()) {
            names.push_back(name);
            contests.emplace_back();
        }
        contests[at].push_back(i);
    }
    return contests;
}

// What is to be small, on a linear scale.
double costOf(const Chart& chart, const ChartPoint& point)
{
    return chart.isError ? point.y : std::pow(10.0, -point.y / 20);
}

bool beats(const Chart& chart, const ChartPoint& a, const ChartPoint& b)
{
    const double sign = chart.isError ? 1 : -1;
    return isDrawn(chart, a) && a.x <= b.x && sign * a.y <= sign * b.y && (a.x < b.x || a.y != b.y);
}

bool clearlyBeats(const Chart& chart, const ChartPoint& a, const ChartPoint& b)
{
    return isDrawn(chart, a) && a.x < (1 - kClearlyBetter) * b.x &&
           costOf(chart, a) < (1 - kClearlyBetter) * costOf(chart, b);
}

// The default's index, or none.
std::optional<size_t> findDefault(const Chart& chart, const std::vector<size_t>& contest)
{
    const auto found = std::find_if(contest.begin(), contest.end(), [&](size_t i) {
        return chart.points[i].isDefault && isDrawn(chart, chart.points[i]);
    });
    return found == contest.end() ? std::nullopt : std::optional(*found);
}

std::vector<size_t> clearlyBetter(const Chart& chart, const std::vector<size_t>& contest)
{
    std::vector<size_t> better;
    if (const std::optional<size_t> usual = findDefault(chart, contest)) {
        std::copy_if(contest.begin(), contest.end(), std::back_inserter(better),
                     [&](size_t i) { return clearlyBeats(chart, chart.points[i], chart.points[*usual]); });
    }
    return better;
}

// Labels may name their series already.
std::string fullName(const ChartPoint& point)
{
    return point.label.rfind(point.series, 0) == 0 ? point.label : point.series + ", " + point.label;
}

} // namespace

bool isDrawn(const Chart& chart, const ChartPoint& point)
{
    return std::isfinite(point.x) && point.x > 0 && std::isfinite(point.y) && (!chart.isError || point.y > 0);
}

std::vector<char> frontOf(const Chart& chart)
{
    std::vector<char> front(chart.points.size(), 0);
    for (const std::vector<size_t>& contest : contestsOf(chart)) {
        for (const size_t i : contest) {
            front[i] = isDrawn(chart, chart.points[i]) && std::none_of(contest.begin(), contest.end(), [&](size_t j) {
                           return beats(chart, chart.points[j], chart.points[i]);
                       });
        }
    }
    return front;
}

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
            names += (names.empty() ? "" : "; ") + fullName(chart.points[i]);
        }
        text += fmt::format("{}The program's default ({}) is beaten by more than {:.0f} % in both by {}.",
                            text.empty() ? "" : " ", fullName(chart.points[*usual]), 100 * kClearlyBetter,
                            names.empty() ? "no other setting" : names);
    }
    return text;
}

} // namespace nacre
