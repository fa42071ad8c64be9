#include "evaluation/charts/chart_axis.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

namespace nacre {

namespace {

constexpr double kMargin = 0.06; // share of the span that is left free on either side
constexpr int kMostTicks = 9;
constexpr double kSteps[] = {1, 2, 5};
constexpr double kFineSteps[] = {1, 1.5, 2, 3, 4, 5, 7};

} // namespace

bool isPlottable(double value, bool isLog)
{
    return std::isfinite(value) && (!isLog || value > 0);
}

double ChartScale::transformed(double value) const
{
    return isLog_ ? std::log10(value) : value;
}

ChartScale::ChartScale(const std::vector<double>& values, bool isLog) : isLog_(isLog)
{
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    first_ = transformed(*least);
    last_ = transformed(*most);
    // Values that are all but equal still need an axis with two ticks or more.
    const double fewest = isLog_ ? std::log10(4.0) : std::max(1e-6, 0.02 * std::abs(first_));
    const double missing = std::max(0.0, fewest - (last_ - first_));
    const double margin = missing / 2 + kMargin * (last_ - first_);
    first_ -= margin;
    last_ += margin;
    isLog_ ? placeLogTicks() : placeLinearTicks();
}

double ChartScale::position(double value) const
{
    return (transformed(value) - first_) / (last_ - first_);
}

// The more of every decade, the fewer decades there are.
void ChartScale::placeLogTicks()
{
    const double span = last_ - first_;
    std::span<const double> steps = kSteps;
    steps = span < 1.05 ? kFineSteps : span < 2.6 ? steps : steps.first(1);
    for (int decade = static_cast<int>(std::floor(first_)); decade <= static_cast<int>(std::floor(last_)); ++decade) {
        for (const double step : steps) {
            const double value = step * std::pow(10.0, decade);
            if (std::log10(value) >= first_ && std::log10(value) <= last_) {
                ticks_.push_back(value);
            }
        }
    }
}

// The smallest step of 1, 2 or 5 times a power of ten that gives few enough.
void ChartScale::placeLinearTicks()
{
    const double span = last_ - first_;
    double step = 0;
    for (int decade = static_cast<int>(std::floor(std::log10(span))) - 1; step == 0; ++decade) {
        for (const double s : kSteps) {
            const double candidate = s * std::pow(10.0, decade);
            if (step == 0 && span / candidate <= kMostTicks - 1) {
                step = candidate;
            }
        }
    }
    for (double i = std::ceil(first_ / step); i * step <= last_; ++i) {
        ticks_.push_back(i * step);
    }
}

std::string tickText(double value)
{
    constexpr struct {
        double factor;
        const char* suffix;
    } kUnits[] = {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}};
    for (const auto& unit : kUnits) {
        if (std::abs(value) >= unit.factor) {
            return fmt::format("{:.4g}{}", value / unit.factor, unit.suffix);
        }
    }
    return fmt::format("{:.4g}", std::abs(value) < 1e-12 ? 0.0 : value);
}

} // namespace nacre
