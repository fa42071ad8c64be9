#pragma once
#include <string>
#include <vector>

namespace nacre {

// One setting: what it costs and what it gives.
struct ChartPoint {
    std::string series; // gives the mark its shape
    std::string label;
    double x = 0; // cost: less is better
    double y = 0;
    bool isDefault = false; // the program's own choice
};

// Settings against each other. A point that the axes cannot show (not finite; not above 0 on a logarithmic axis) takes
// no part.
struct Chart {
    std::string title, xLabel, yLabel; // the latter with their units
    bool isError = true;               // y: less is better, axis logarithmic; otherwise decibels, more is better
    std::vector<ChartPoint> points;
    // Series are then different questions, not different answers: each has its own front and its own default.
    bool isFrontPerSeries = false;
};

bool isDrawn(const Chart& chart, const ChartPoint& point);

// 1 for each point that no other of its contest (all points, or those of its series) beats on both axes. Equal points
// do not beat each other.
std::vector<char> frontOf(const Chart& chart);

// By less than this much, nobody would change a default, and one run's times cannot tell.
constexpr double kClearlyBetter = 0.1;

// The points that beat their contest's default by more than kClearlyBetter on both axes: less by that share of the
// default's value. Where more is better values are decibels, and errors behind them (20 dB to a factor of ten) are
// compared.
std::vector<size_t> clearlyBetter(const Chart& chart);

// A sentence on every default: what beats it. Empty where no default was measured.
std::string describeDefault(const Chart& chart);

} // namespace nacre
