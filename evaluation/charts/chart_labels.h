#pragma once
#include <string>
#include <vector>

namespace nacre {

// In pixels, y downwards.
struct LabelBox {
    double x = 0, y = 0, width = 0, height = 0; // x, y: top left
};

bool overlap(const LabelBox& a, const LabelBox& b);

struct LabelAnchor {
    double x = 0, y = 0;
    std::string text;
};

struct PlacedLabel {
    LabelAnchor anchor;
    LabelBox box;
};

constexpr double kLabelHeight = 14;
// What a text takes in a sans serif of 11 pixels, generously: the reader's font is not known.
double labelWidth(const std::string& text);

// Each text near its anchor, within `frame`, over none of `taken` and over no other label: the nearest of places
// around it, the first of equals. Texts for which no place is free are left out.
std::vector<PlacedLabel> placeLabels(const std::vector<LabelAnchor>& anchors, std::vector<LabelBox> taken,
                                     const LabelBox& frame);

} // namespace nacre
