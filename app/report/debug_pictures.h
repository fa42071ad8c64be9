#pragma once
#include <filesystem>

#include "engine/surface/surface.h"

namespace nacre {

// Made where it is missing; an existing folder is written into.
void makeDebugFolder(const std::filesystem::path& folder);

// normals.png (n = 2 v - 1), confidence.png.
void saveNormalPictures(const std::filesystem::path& folder, const NormalMap& normals);

// The material on a sphere, lit from the upper left: display values, exposed.
Image ballPicture(const BrdfTable& table);

// Of each material; where there are several, -1, -2 ... stand before .png.
// brdf.png: slices of constant phiD (three rows: 0, the middle, the largest), thetaH across, thetaD down, exposed;
// brdf_coverage.png: the same slices of the confidence; ball.png: ballPicture.
void saveMaterialPictures(const std::filesystem::path& folder, const std::vector<Material>& materials);

} // namespace nacre
