#include "engine/target/texture_files.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/files/error.h"
#include "engine/files/text_files.h"
#include "engine/files/whole_file.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

std::string decodedUri(const std::string& name)
{
    std::string text;
    for (size_t i = 0; i < name.size(); ++i) {
        unsigned code = 0;
        const char* const digits = name.data() + i + 1;
        const bool isCode =
            name[i] == '%' && i + 2 < name.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
        text += isCode ? static_cast<char>(code) : name[i];
        i += isCode ? 2 : 0;
    }
    return text;
}

// The one file whose last name differs in case alone; empty where there is none, or several.
fs::path byOtherCase(const fs::path& file)
{
    fs::path found;
    std::error_code ignored;
    for (const fs::directory_entry& entry :
         fs::directory_iterator(file.parent_path().empty() ? "." : file.parent_path(), ignored)) {
        if (comparable(entry.path().filename().string()) == comparable(file.filename().string())) {
            if (!found.empty()) {
                return {};
            }
            found = entry.path();
        }
    }
    return found;
}

// The JSON of a glTF file: the file, or a .glb's first chunk (glTF 2.0, 4.4). Empty where it is none.
std::string gltfText(const fs::path& mesh)
{
    constexpr size_t kHead = 12, kChunkHead = 8;
    const std::string bytes = readWholeFile(mesh, "a mesh file");
    if (!bytes.starts_with("glTF")) {
        return bytes;
    }
    size_t size = 0;
    for (size_t i = 4; i-- > 0 && bytes.size() > kHead + kChunkHead;) { // little endian
        size = size << 8 | static_cast<unsigned char>(bytes[kHead + i]);
    }
    return bytes.substr(std::min(kHead + kChunkHead, bytes.size()), size);
}

// Those that are read, and those that change neither shape nor normals.
bool isKnown(std::string_view extension)
{
    constexpr std::array<std::string_view, 4> kKnown = {"KHR_texture_transform", "KHR_lights_punctual",
                                                        "KHR_xmp_json_ld", "EXT_texture_webp"};
    return extension.starts_with("KHR_materials_") ||
           std::find(kKnown.begin(), kKnown.end(), extension) != kKnown.end();
}

} // namespace

fs::path textureFile(const fs::path& mesh, const std::string& name)
{
    const fs::path folder = mesh.parent_path();
    std::string slashes = name;
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    for (const std::string& form : {name, decodedUri(name), slashes}) {
        if (fs::is_regular_file(folder / form)) {
            return folder / form;
        }
    }
    for (const std::string& form : {decodedUri(name), slashes}) {
        if (const fs::path found = byOtherCase(folder / form); !found.empty()) {
            return found;
        }
    }
    return folder / name;
}

void requireKnownExtensions(const fs::path& mesh)
{
    const nlohmann::json json = nlohmann::json::parse(gltfText(mesh), nullptr, false);
    if (!json.is_object() || !json.contains("extensionsRequired") || !json["extensionsRequired"].is_array()) {
        return;
    }
    for (const nlohmann::json& extension : json["extensionsRequired"]) {
        if (extension.is_string() && !isKnown(extension.get<std::string>())) {
            throw Error(mesh, fmt::format("requires {}", extension.get<std::string>()),
                        "a glTF file without this extension, as its program may export it");
        }
    }
}

} // namespace nacre
