#pragma once
#include <filesystem>

namespace nacre {

// Throws Error (data) where a PLY holds fewer values than its header announces (Turk, "The PLY Polygon File Format",
// 1994), or its header has no end.
void requireWholePly(const std::filesystem::path& file);

} // namespace nacre
