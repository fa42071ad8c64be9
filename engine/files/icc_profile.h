#pragma once
#include <optional>
#include <span>

#include "engine/files/transfer_curve.h"

namespace nacre {

// What an ICC profile (ICC.1:2010) says of light: the curve of its green, or of its grey, as pictures with one curve a
// channel are not photographs.
struct IccColour {
    TransferCurve curve;
    bool hasOtherPrimaries = false; // than Rec. 709
};

// None where the profile is damaged, or holds tables of colours instead of curves.
std::optional<IccColour> readIccProfile(std::span<const unsigned char> profile);

} // namespace nacre
