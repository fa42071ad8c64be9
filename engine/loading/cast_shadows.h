#pragma once
#include <filesystem>

#include "engine/surface/surface.h"

namespace nacre {

// Bakes the horizon of the height of a surface that was read from `source`. A captured surface has none: its normals
// are integrated, and stderr says so. Throws Error (usage) for a bare normal map.
void castShadows(Surface& surface, const std::filesystem::path& source);

} // namespace nacre
