#pragma once
#include <string>
#include <vector>

namespace nacre {

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

// Horizontal bars below each other as an SVG picture that can be read at a telephone's width. `full`: the length that
// fills the width.
std::string barFigure(const std::vector<Bar>& bars, double full, const std::vector<BarLegend>& legend);

} // namespace nacre
