#pragma once
#include <filesystem>

#include "engine/files/text_files.h"

namespace nacre {

// NumPy's `.npy` (NEP 1, format versions 1 to 3): a table of 32- or 64-bit floats, little-endian, row by row. Throws
// Error, naming what the file has instead.
NumberTable loadNpyTable(const std::filesystem::path& file);

} // namespace nacre
