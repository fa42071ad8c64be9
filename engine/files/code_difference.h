#pragma once
#include <cstdint>
#include <span>

#include "engine/files/image.h"

namespace nacre {

// How far apart two pictures of 8-bit codes are (values n/255), over the mask, each pixel by its worst channel.
struct CodeDifference {
    int largest = 0;   // codes
    size_t beyond = 0; // pixels off by more than `tolerance` codes
    size_t pixels = 0; // in the mask
    double share() const { return pixels == 0 ? 0.0 : static_cast<double>(beyond) / static_cast<double>(pixels); }
};

CodeDifference codeDifference(const Image& a, const Image& b, std::span<const uint8_t> mask, int tolerance);
CodeDifference codeDifference(const Image& a, const Image& b, int tolerance);

} // namespace nacre
