#include "engine/target/mesh_texture.h"

#include <span>

#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "engine/scene/error.h"
#include "engine/scene/whole_file.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

// Picture readers want a file: one beside nothing else, gone again at the end.
class TemporaryPicture {
public:
    explicit TemporaryPicture(const aiTexture& texture)
    {
        std::string folder = (fs::temp_directory_path() / "nacre-XXXXXX").string();
        if (!mkdtemp(folder.data())) {
            throw Error(folder, "cannot be made", "a folder for temporary files that may be written");
        }
        folder_ = folder;
        const auto* bytes = reinterpret_cast<const unsigned char*>(texture.pcData);
        writeWholeFile(file(texture), std::span(bytes, texture.mWidth));
    }
    ~TemporaryPicture()
    {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    TemporaryPicture(const TemporaryPicture&) = delete;
    TemporaryPicture& operator=(const TemporaryPicture&) = delete;

    fs::path file(const aiTexture& texture) const
    {
        return folder_ / fmt::format("embedded.{}", texture.achFormatHint);
    }

private:
    fs::path folder_;
};

NormalMap embeddedNormalMap(const fs::path& mesh, const aiTexture& texture, NormalY normalY)
{
    if (texture.mHeight != 0) { // raw texels, which no format that is read here has
        throw Error(mesh, "embeds a normal map without a picture format", "PNG or JPEG");
    }
    const TemporaryPicture picture(texture);
    try {
        return loadNormalMap(picture.file(texture), normalY);
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
