#pragma once
#include <string>

#include "engine/scene/false_colour.h"

namespace nacre {

// The words of --show and --tone; empty: the default. The inverses answer the word. Throw Error (usage).
Show showFromName(const std::string& name);
std::string nameOf(Show show);
int toneCurveFromName(const std::string& name);
std::string nameOfToneCurve(int toneCurve);

} // namespace nacre
