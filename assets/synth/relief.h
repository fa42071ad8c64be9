#pragma once
#include <functional>

#include <glm/vec2.hpp>

#include "assets/synth/target.h"

namespace nacre {

// A surface as a height over the picture's plane: the picture's shorter side spans [-1, 1], x right, y up, the
// picture's middle is the origin; heights in the same unit, towards the viewer.
struct ReliefPoint {
    double height;
    uint8_t part;
};
using Relief = std::function<ReliefPoint(const glm::dvec2&)>;

// A pixel's normal and height are means over its area and its label is the commonest part, so that a small picture is
// the large one filtered: no aliasing. The relief is to be continuous.
Target targetFromRelief(int width, int height, std::vector<std::string> parts, const Relief& relief, int threads);

// Distance between the samples that a picture is made of, in the plane's unit: detail finer than twice this is to be
// left out.
double reliefSpacing(int width, int height);

// How much of a detail is to be drawn whose period is `period`: all at four samples, nothing at two.
double detailShare(double period, double spacing);

} // namespace nacre
