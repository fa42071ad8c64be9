#pragma once
#include <string>
#include <vector>

#include "assets/synth/target.h"

namespace nacre {

// One way of naming our own targets: NAME[:WORD][,KEY=NUMBER]..., e.g. "cloth:twill,threads=32,curl=0.5", "knit",
// "letters:NACRE". assets/README.md has them all. The same bytes for any number of threads (0 = all).
// Throws Error (usage) that lists what there is, where a name, a word, a key or a number is none of it.
Target makeTarget(const std::string& specification, int width, int height, int threads = 0);

struct TargetName {
    std::string name;
    std::string description; // one line, with the keys, their defaults and ranges
};

std::vector<TargetName> targetNames();

} // namespace nacre
