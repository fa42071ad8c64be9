#pragma once
#include <filesystem>
#include <string>

namespace nacre {

// The file that a mesh means by a texture's name: as it stands, with the %20 of URIs decoded, with the backslashes of
// Windows as slashes, and by another case of letters where one file alone agrees. Where nothing is there, as it stands.
std::filesystem::path textureFile(const std::filesystem::path& mesh, const std::string& name);

// Throws Error where a glTF file requires an extension without which its shape or normals would be others.
void requireKnownExtensions(const std::filesystem::path& mesh);

} // namespace nacre
