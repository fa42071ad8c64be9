#pragma once
#include <filesystem>

namespace nacre {

// Assimp's readers end the program on some damaged files, so a process of its own reads each file first. Throws Error
// (data) where that process does not come back.
void requireHarmlessMesh(const std::filesystem::path& file);

} // namespace nacre
