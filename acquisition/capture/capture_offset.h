#pragma once
#include <string>

#include "acquisition/capture/capture.h"

namespace nacre {

struct OffsetEstimate {
    float value = 0;    // 0 where the photographs show none
    std::string reason; // for the user
};

// The constant that every value carries (black level, stray light), where shadows show it: a pixel's least value over
// all photographs is the offset where any of them leaves it in shadow, so that the low quantiles of these least values
// agree, while without an offset or without shadows they spread down to 0. Reads every photograph once.
OffsetEstimate estimateOffset(const Capture& capture, int threads = 0);

} // namespace nacre
