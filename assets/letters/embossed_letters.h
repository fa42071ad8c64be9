#pragma once
#include <string>

#include "assets/synth/target.h"

namespace nacre {

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
