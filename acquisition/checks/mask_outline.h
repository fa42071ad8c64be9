#pragma once
#include <cstdint>
#include <vector>

#include "acquisition/capture/finding.h"
#include "acquisition/capture/observations.h"

namespace nacre {

// A warning where a mask's outline is no outline in the photographs, as another object's is not: what lies on its two
// sides differs, over all photographs, no more than it does where the same outline is put elsewhere in the picture.
// `seen` has every pixel of the picture, which is seen.width wide, in order; `mask` is as large.
SelfChecks checkMaskOutline(const Observations& seen, const std::vector<uint8_t>& mask);

} // namespace nacre
