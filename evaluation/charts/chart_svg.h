#pragma once
#include <string>
#include <vector>

#include "evaluation/charts/chart_axis.h"

namespace nacre {

// One setting: what it costs and what it gives.
struct ChartPoint {
    std::string series; // gives the marker its shape
    std::string label;  // written beside the point where it is on the front or the default
    double x = 0;
    double y = 0;
    bool isDefault = false; // the program's own choice
};

struct Chart {
    std::string title;
    ChartAxis x, y;
    std::vector<ChartPoint> points;
    // Series are then different questions, not different answers: each has its own front and its own default.
    bool isFrontPerSeries = false;
};

// The points that compete with each other, as indices: all of them, or those of each series.
std::vector<std::vector<size_t>> contestsOf(const Chart& chart);

// 1 for each point that no other of its contest beats on both axes; points that cannot be drawn are not on it.
std::vector<char> frontOf(const Chart& chart);

// A picture of its own (SVG 1.1): the front as a line through coloured points, dominated points grey, a ring about the
// default, a legend below. Points that an axis cannot show (not finite; not above 0 on a log axis) are left out.
std::string svgOf(const Chart& chart);

} // namespace nacre
