#pragma once
#include <string>
#include <vector>

#include "evaluation/charts/chart_svg.h"

namespace nacre {

// By less than this much, nobody would change a default, and one run's times cannot tell.
constexpr double kClearlyBetter = 0.1;

// The points that beat their contest's default by more than kClearlyBetter on both axes: less by that share of the
// default's value. Where more is better values are decibels, and errors behind them (20 dB to a factor of ten) are
// compared.
std::vector<size_t> clearlyBetter(const Chart& chart);

// The same for people, a sentence for each contest; empty where no default was measured.
std::string describeDefault(const Chart& chart);

} // namespace nacre
