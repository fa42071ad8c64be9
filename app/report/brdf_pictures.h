#pragma once
#include <filesystem>

#include "engine/materials/material_specification.h"

namespace nacre {

// slices.png: f over thetaH (right, 0 to 90 degrees, square root) and thetaD (down) for several phiD, on a logarithmic
// scale from 1e-4 of the peak; grey where light or view is below the horizon, hatched where it is not covered.
// sphere.png: a ball of the material under lights at several angles from the view, all exposed alike, and the same
// three stops brighter. `folder` is made; pictures of these names in it are refused without `replace`.
void saveBrdfPictures(const std::filesystem::path& folder, const BrdfSource& source, bool replace, int threads);

} // namespace nacre
