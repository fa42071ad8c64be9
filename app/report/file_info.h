#pragma once
#include <filesystem>

namespace nacre {

// Says what a file holds that Nacre reads or writes, or a relightable picture's web folder. Throws Error (data) where
// it is of no kind that is known.
void printFile(const std::filesystem::path& file);

} // namespace nacre
