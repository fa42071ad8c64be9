#pragma once
#include <span>
#include <string>
#include <vector>

#include "evaluation/charts/chart.h"
#include "evaluation/charts/chart_settings.h"

namespace nacre {

// Rows of one capture follow each other: a part for each.
template <class Row> std::vector<std::span<const Row>> byCapture(const std::vector<Row>& rows)
{
    std::vector<std::span<const Row>> parts;
    for (size_t first = 0, last = 0; first < rows.size(); first = last) {
        while (last < rows.size() && rows[last].capture == rows[first].capture) {
            ++last;
        }
        parts.push_back(std::span(rows).subspan(first, last - first));
    }
    return parts;
}

// One capture's settings against each other.
Chart normalChart(std::span<const NormalRow> rows);    // against time
Chart bytesChart(std::span<const BrdfRow> rows);       // against the tables' size
Chart bakingChart(std::span<const BrdfRow> rows);      // against time; formats need no baking of their own
Chart steadyChart(std::span<const RenderingRow> rows); // frames; each number of lights for itself
Chart movedChart(std::span<const RenderingRow> rows);  // the first frame after every light has moved

// Comma-separated values, a line a setting under a heading (RFC 4180). Empty fields: not measured.
std::string csvOf(const std::vector<NormalRow>& rows);
std::string csvOf(const std::vector<BrdfRow>& rows);
std::string csvOf(const std::vector<RenderingRow>& rows);

// A text as one field: in quotes where it holds a comma or a quote. Line breaks become spaces.
std::string csvField(const std::string& text);

} // namespace nacre
