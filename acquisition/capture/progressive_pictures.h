#pragma once
#include <filesystem>

namespace nacre {

// True for interlaced PNGs and progressive JPEGs: no row is complete before the end of the file, so decoders that
// answer row by row hold the whole picture all the same.
bool isProgressive(const std::filesystem::path& file);

} // namespace nacre
