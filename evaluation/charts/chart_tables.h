#pragma once
#include <string>
#include <vector>

#include "evaluation/charts/chart_settings.h"

namespace nacre {

// Comma-separated values, a line a setting under a heading (RFC 4180). Empty fields: not measured.
std::string csvOf(const std::vector<NormalRow>& rows);
std::string csvOf(const std::vector<BrdfRow>& rows);
std::string csvOf(const std::vector<RenderingRow>& rows);

// A text as one field: in quotes where it holds a comma, a quote or a line break.
std::string csvField(const std::string& text);

} // namespace nacre
