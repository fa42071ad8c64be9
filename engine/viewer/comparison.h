#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "engine/files/image.h"
#include "engine/scene/scene.h"
#include "engine/viewer/controls.h"

namespace nacre {

inline constexpr float kDifferenceGain = 2; // of codes, around middle grey

// The picture fitted into another size as surfaces are (fittedPixels), 0 outside.
Image fittedPicture(const Image& picture, int width, int height);

// What stands in place of the render: the photograph exposed as the render is, or the difference of both's codes,
// brighter than middle grey where the photograph is.
Image comparisonPicture(Comparison comparison, const Image& photograph, const Image& render, const Display& display);

// PSNR of radiance over the pixels that have a material, and the mean of photograph over render there.
std::string describeComparison(const Image& photograph, const Frame& render, const Surface& surface, double peak);

} // namespace nacre
