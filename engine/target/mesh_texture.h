#pragma once
#include <filesystem>

#include "engine/surface/normal_map.h"

struct aiMaterial;
struct aiScene;

namespace nacre {

// The tangent-space normal map that a material names, beside the mesh or within the file; 0x0 where it names none.
// Bump maps (heights) do not count. Throws Error (data) where it cannot be read.
NormalMap materialNormalMap(const std::filesystem::path& mesh, const aiScene& scene, const aiMaterial& material,
                            NormalY normalY);

} // namespace nacre
