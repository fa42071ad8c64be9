#pragma once
#include <filesystem>

#include "engine/surface/normal_map.h"

namespace nacre {

// The true normals of a benchmark: MATLAB `.mat` with an h x w x 3 array (DiLiGenT's `Normal_gt`), or what
// loadNormalMap reads. Zero vectors are no data.
NormalMap loadTrueNormals(const std::filesystem::path& file);

} // namespace nacre
