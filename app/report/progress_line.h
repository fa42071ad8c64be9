#pragma once
#include "acquisition/chain/acquire.h"

namespace nacre {

// One line on stderr that overwrites itself; silent where stderr is no terminal or `quiet` is set.
Progress progressLine(bool quiet);

// Clears the line, if there is one.
void endProgressLine(bool quiet);

} // namespace nacre
