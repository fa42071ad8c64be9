#include "evaluation/chart_default.h"

#include <algorithm>
#include <cmath>

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

auto findDefault(const Chart& chart)
{
    return std::find_if(chart.points.begin(), chart.points.end(),
                        [](const ChartPoint& point) { return point.isDefault && std::isfinite(point.y); });
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
    const auto usual = findDefault(chart);
    for (size_t i = 0; i < chart.points.size() && usual != chart.points.end(); ++i) {
        const ChartPoint& point = chart.points[i];
        if (isClearlyLess(chart.x, point.x, usual->x) && isClearlyLess(chart.y, point.y, usual->y)) {
            better.push_back(i);
        }
    }
    return better;
}

std::string describeDefault(const Chart& chart)
{
    const auto usual = findDefault(chart);
    if (usual == chart.points.end()) {
        return {};
    }
    std::string names;
    for (const size_t i : clearlyBetter(chart)) {
        const ChartPoint& point = chart.points[i];
        names += (names.empty() ? "" : "; ") + nameOf(point);
    }
    return fmt::format("The program's default ({}) is beaten by more than {:.0f} % in both by {}.", nameOf(*usual),
                       100 * kClearlyBetter, names.empty() ? "no other setting" : names);
}

} // namespace nacre
