#pragma once
#include "acquisition/chain/acquire_options.h"
#include "acquisition/chain/normal_estimation.h"

namespace nacre {

// Self-checks that look at the picture around the object as well, in a few well-spread photographs of those in use:
// its mask's outline, camera shake.
SelfChecks checkPicture(const Capture& capture, const PreparedCapture& prepared);

} // namespace nacre
