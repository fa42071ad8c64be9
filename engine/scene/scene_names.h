#pragma once
#include <string>

#include "engine/scene/false_colour.h"
#include "engine/surface/residual_layer.h"

namespace nacre {

// The words of --show, --tone and --residual; empty: the default. The inverses answer the word. Throw Error (usage).
Show showFromName(const std::string& name);
std::string nameOf(Show show);
int toneCurveFromName(const std::string& name);
std::string nameOfToneCurve(int toneCurve);
ResidualUse residualUseFromName(const std::string& name);
std::string nameOf(ResidualUse use);

} // namespace nacre
