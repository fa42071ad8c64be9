#pragma once
#include <filesystem>

#include "acquisition/chain/acquire.h"
#include "acquisition/segmentation/segmentation.h"
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

// labels.png: a colour for each material, darker at the borders that no BRDF is sampled from, black beside the object.
void saveLabelPicture(const std::filesystem::path& folder, const Segmentation& segmentation, int width, int height);

// verdicts.png: per light a small picture of how each pixel's observation was judged (white used, blue shadow, yellow
// highlight, red saturated), with the photograph's name.
void saveVerdictPictures(const std::filesystem::path& folder, const Capture& capture, const NormalEstimate& estimate);

} // namespace nacre
