#pragma once
#include <optional>
#include <string>
#include <vector>

#include "evaluation/stress.h"

namespace nacre {

// A line per row under a heading (RFC 4180: a text with a comma, quote or line break stands in quotes).
std::string csvOf(const std::vector<StressRow>& rows);

// Per sweep a table for people: mean degrees, a column per method, a line per setting.
std::string tablesOf(const std::vector<StressRow>& rows);

// Where a method's curve breaks: the first setting whose mean error is twice that of the mildest, or passes 5 degrees
// where the mildest does not. Rows of one sweep and method, in the sweep's order.
std::optional<size_t> breakingPoint(const std::vector<StressRow>& curve);

// A line per sweep, a column per method: the setting where it breaks.
std::string breakingPointsOf(const std::vector<StressRow>& rows);

} // namespace nacre
