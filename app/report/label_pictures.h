#pragma once
#include <filesystem>

#include "acquisition/segmentation/segmentation.h"

namespace nacre {

// labels.png: a colour for each material, darker at the borders that no BRDF is sampled from, black beside the object.
void saveLabelPicture(const std::filesystem::path& folder, const Segmentation& segmentation, int width, int height);

} // namespace nacre
