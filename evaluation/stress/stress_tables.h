#pragma once
#include <optional>
#include <string>
#include <vector>

#include "evaluation/stress/stress.h"

namespace nacre {

// In the order in which they first appear.
std::vector<std::string> distinctOf(const std::vector<StressRow>& rows, std::string StressRow::*member);
std::vector<StressRow> rowsWhere(const std::vector<StressRow>& rows, std::string StressRow::*member,
                                 const std::string& value);

// A line per row under a heading (RFC 4180). `breaking`: the first broken setting of a method in a sweep.
std::string csvOf(const std::vector<StressRow>& rows);
const char* errorUnitOf(const StressRow& row); // as the table names it

// Per sweep a table for people: the error, a column per method, a line per setting.
std::string tablesOf(const std::vector<StressRow>& rows);

// Where a method's curve breaks: the first broken row. Rows of one sweep and method, in the sweep's order.
std::optional<size_t> breakingPoint(const std::vector<StressRow>& curve);

// A line per sweep, a column per method: the setting where it breaks.
std::string breakingPointsOf(const std::vector<StressRow>& rows);

struct StressCounts {
    size_t runs = 0, broken = 0, said = 0, silent = 0; // said + silent = broken
    size_t overconfident = 0;                          // not broken, but see kWrongShare
    size_t falseAlarms = 0, mildestAlarms = 0;         // the latter at the first setting of a sweep
};
StressCounts countsOf(const std::vector<StressRow>& rows);

// A line per method, and one for all.
std::string countTableOf(const std::vector<StressRow>& rows);

} // namespace nacre
