#pragma once
#include <string>

#include "acquisition/brdf/model_ladder.h"

namespace nacre {

// The steps that are better than every smaller one, with the one that is taken; the others are counted.
std::string describe(const ModelLadder& ladder); // empty where none was asked for

} // namespace nacre
