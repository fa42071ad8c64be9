#include "engine/target/mesh_texture.h"

#include <span>

#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/files/whole_file.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

NormalMap embeddedNormalMap(const fs::path& mesh, const aiTexture& texture, NormalY normalY)
{
    if (texture.mHeight != 0) { // raw texels, which no format that is read here has
        throw Error(mesh, "embeds a normal map without a picture format", "PNG or JPEG");
    }
    const TemporaryFolder folder; // picture readers want a file
    const fs::path file = folder.path() / fmt::format("embedded.{}", texture.achFormatHint);
    const auto* bytes = reinterpret_cast<const unsigned char*>(texture.pcData);
    writeWholeFile(file, std::span(bytes, texture.mWidth));
    try {
        return loadNormalMap(file, normalY);
    } catch (const Error& error) {
        throw Error(mesh, "its embedded normal map: " + std::string(error.what()), "a normal map in PNG or JPEG");
    }
}

} // namespace

NormalMap materialNormalMap(const fs::path& mesh, const aiScene& scene, const aiMaterial& material, NormalY normalY)
{
    aiString name;
    if (material.GetTexture(aiTextureType_NORMALS, 0, &name) != aiReturn_SUCCESS) {
        return {};
    }
    if (const aiTexture* texture = scene.GetEmbeddedTexture(name.C_Str())) {
        return embeddedNormalMap(mesh, *texture, normalY);
    }
    return loadNormalMap(mesh.parent_path() / name.C_Str(), normalY);
}

} // namespace nacre
