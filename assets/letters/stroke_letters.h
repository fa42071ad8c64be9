#pragma once
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace nacre {

// Our own capitals, digits and signs as centre lines of strokes: no font file, sharp at any size.

using Stroke = std::vector<glm::dvec2>; // joined points

struct Glyph {
    std::vector<Stroke> strokes; // x from 0 to width, y from the baseline (0) to the capitals' height (1)
    double width = 0;
};

// Small letters are drawn as capitals; false for what there is no drawing of.
bool hasGlyph(char letter);
Glyph glyphOf(char letter);
std::string glyphLetters(); // all that there are

double distanceToStroke(const glm::dvec2& p, const Stroke& stroke);

} // namespace nacre
