#pragma once
#include <array>
#include <filesystem>
#include <string>

namespace nacre {

// The file that a mesh means by a texture's name: as it stands, with the %20 of URIs decoded, with the backslashes of
// Windows as slashes, and by another case of letters where one file alone agrees. Where nothing is there, as it stands.
std::filesystem::path textureFile(const std::filesystem::path& mesh, const std::string& name);

// u, v of a texture: offset + scale * the mesh's, v counting up.
struct UvPlacement {
    std::array<float, 2> scale = {1, 1}, offset = {0, 0};
};

// The options -s and -o of the normal map that a material of an OBJ's MTL files names: they are read here since Assimp
// passes over them.
UvPlacement mtlPlacement(const std::filesystem::path& obj, const std::string& material);

// Throws Error where a glTF file requires an extension without which its shape or normals would be others, or moves a
// normal map from one set of coordinates to another (KHR_texture_transform), which Assimp passes over.
void requireKnownExtensions(const std::filesystem::path& mesh);

} // namespace nacre
