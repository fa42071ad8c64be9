#include "evaluation/charts/chart_labels.h"

#include <algorithm>
#include <cmath>

namespace nacre {

namespace {

constexpr double kDistances[] = {9, 18, 28, 40, 54, 70, 90, 112};
constexpr int kDirections = 16;

bool contains(const LabelBox& frame, const LabelBox& box)
{
    return box.x >= frame.x && box.y >= frame.y && box.x + box.width <= frame.x + frame.width &&
           box.y + box.height <= frame.y + frame.height;
}

// The box that a text takes whose nearest side or corner lies so far from the anchor, in that direction.
LabelBox boxAt(const LabelAnchor& anchor, double distance, double angle)
{
    const double width = labelWidth(anchor.text), dx = std::cos(angle), dy = -std::sin(angle);
    const double x = anchor.x + distance * dx, y = anchor.y + distance * dy;
    // Continuous in the angle, so that boxes above and below stand centred.
    return {x - width * (1 - dx) / 2, y - kLabelHeight * (1 - dy) / 2, width, kLabelHeight};
}

} // namespace

bool overlap(const LabelBox& a, const LabelBox& b)
{
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

double labelWidth(const std::string& text)
{
    constexpr double kLetter = 6.4;
    return kLetter * static_cast<double>(text.size()) + 2;
}

std::vector<PlacedLabel> placeLabels(const std::vector<LabelAnchor>& anchors, std::vector<LabelBox> taken,
                                     const LabelBox& frame)
{
    constexpr double kPi = 3.14159265358979;
    std::vector<PlacedLabel> placed;
    const auto place = [&](const LabelAnchor& anchor) {
        for (const double distance : kDistances) {
            for (int i = 0; i < kDirections; ++i) {
                const LabelBox box = boxAt(anchor, distance, 2 * kPi * i / kDirections);
                if (contains(frame, box) && std::none_of(taken.begin(), taken.end(),
                                                         [&](const LabelBox& other) { return overlap(box, other); })) {
                    taken.push_back(box);
                    placed.push_back({anchor, box});
                    return;
                }
            }
        }
    };
    std::for_each(anchors.begin(), anchors.end(), place);
    return placed;
}

} // namespace nacre
