#pragma once
#include <filesystem>

namespace nacre {

// What a file that was dropped onto the window is taken for.
enum class Dropped { surface, target, material, environment, state, unknown };

// By its content where the name does not tell: a folder with surface.json is a surface, or a target where it has no
// material; an EXR with a table in it is a material; one twice as wide as high whose values are no unit vectors is an
// environment; any other picture is a normal map.
Dropped kindOf(const std::filesystem::path& file);

// "a material"
const char* nameOf(Dropped kind);

} // namespace nacre
