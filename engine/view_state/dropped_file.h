#pragma once
#include <filesystem>

namespace nacre {

// What a file that was dropped onto the window is taken for.
enum class Dropped { surface, target, material, environment, state, unknown };

// By its content where the name does not tell: a folder with surface.json is a surface, or a target where it has no
// material; an EXR with a table in it is a material, any other picture a normal map.
Dropped kindOf(const std::filesystem::path& file);

} // namespace nacre
