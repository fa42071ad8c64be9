#pragma once
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "assets/synth/target.h"

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

// A cast plate with a raised rim and raised letters.
struct EmbossedLettersOptions {
    std::string text = "NACRE"; // hasGlyph; "/" ends a line
    double stroke = 0.24;       // breadth of the letters' strokes over their height
    double bevel = 0.6;         // share of the stroke's half breadth that slopes; 1 = a ridge
    double relief = 0.13;       // how far letters rise, over their height
    double roughness = 1;       // unevenness of the cast; 0 = none
    uint64_t seed = 1;
};

// Parts: plate, letters. Throws Error (usage) where a letter has no drawing, or there is none.
Target embossedLetters(int width, int height, const EmbossedLettersOptions& options = {}, int threads = 0);

} // namespace nacre
