#pragma once
#include <filesystem>

namespace nacre {

// Readers take a file that ends too early for a smaller one. Throws Error (data), with what was expected, where the
// file does not exist, is empty, or is shorter than it says of itself: the counts of PLY's header, the lengths in GLB
// and binary STL, the last word of text STL, the last brace of glTF, an OBJ line that breaks off. What an OBJ lost
// after a whole line shows in nothing.
void requireWholeMeshFile(const std::filesystem::path& file);

} // namespace nacre
