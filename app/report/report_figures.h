#pragma once
#include <string>
#include <vector>

#include "engine/brdf/brdf_table.h"
#include "evaluation/held_out/capture_review.h"

namespace nacre {

// Small figures of the acquisition's report, SVG within the page, that can be read at a telephone's width.

// Of a bar, from left to right.
struct BarPart {
    double length = 0;
    const char* colour = "";
};

struct Bar {
    std::string name; // to the left, shortened where it is long; empty: the bar belongs to the one above
    std::string text; // to the right
    std::vector<BarPart> parts;
};

struct BarLegend {
    const char* colour;
    std::string meaning;
};

// Horizontal bars below each other. `full`: the length that fills the width.
std::string barFigure(const std::vector<Bar>& bars, double full, const std::vector<BarLegend>& legend);

// The lights as the object sees them: the viewer in the middle, 90 degrees from it on the rim, up is
// up. Blue: given; orange: held back, or not given.
std::string lightFigure(const std::vector<ReviewedPhotograph>& photographs);

// What share of a table's texels was measured, over its first two coordinates.
std::string coverageFigure(const BrdfTable& table);

} // namespace nacre
