#pragma once
#include <filesystem>

namespace nacre {

// Assimp 5.2 does not refuse PLY files that are cut off: it aborts, reads beyond its memory, does not return or makes
// up vertices; of triangle strips it makes one triangle. Throws Error (data) where a PLY has strips, holds fewer values
// than its header announces (Turk, "The PLY Polygon File Format", 1994), or its header has no end.
void requireWholePly(const std::filesystem::path& file);

} // namespace nacre
