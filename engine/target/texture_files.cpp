#include "engine/target/texture_files.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <sstream>
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

// The first set by default (glTF 2.0, 5.30.2).
int setOf(const nlohmann::json& texture, int otherwise)
{
    return texture.is_object() && texture.contains("texCoord") && texture["texCoord"].is_number_integer()
               ? texture["texCoord"].get<int>()
               : otherwise;
}

bool movesSet(const nlohmann::json& material)
{
    static const nlohmann::json::json_pointer kTexture("/normalTexture"),
        kTransform("/normalTexture/extensions/KHR_texture_transform");
    if (!material.is_object() || !material.contains(kTransform)) {
        return false;
    }
    const int set = setOf(material[kTexture], 0);
    return setOf(material[kTransform], set) != set;
}

bool namesNormalMap(std::string_view key)
{
    const std::string lower = lowerCase(std::string(key));
    return lower == "norm" || lower == "map_kn" || lower == "map_bump" || lower == "bump";
}

// Two numbers after the option; as they were where it is not there.
void takeOption(std::string_view option, const std::vector<std::string>& words, std::array<float, 2>& values)
{
    const auto at = std::find(words.begin(), words.end(), option);
    for (size_t k = 0; k < 2 && at != words.end() && std::distance(at, words.end()) > static_cast<long>(k) + 1; ++k) {
        values[k] = static_cast<float>(parseNumber(at[static_cast<long>(k) + 1]).value_or(values[k]));
    }
}

std::vector<std::string> wordsOf(const std::string& line)
{
    std::istringstream stream(line);
    return {std::istream_iterator<std::string>(stream), {}};
}

// Of a material in one MTL file.
void takePlacement(const fs::path& file, const std::string& material, UvPlacement& placement)
{
    std::ifstream stream(file);
    bool isNamed = false;
    for (std::string line; std::getline(stream, line);) {
        const std::vector<std::string> words = wordsOf(line);
        if (words.size() > 1 && words[0] == "newmtl") {
            isNamed = words[1] == material;
        } else if (isNamed && words.size() > 1 && namesNormalMap(words[0])) {
            takeOption("-s", words, placement.scale);
            takeOption("-o", words, placement.offset);
        }
    }
}

} // namespace

UvPlacement mtlPlacement(const fs::path& obj, const std::string& material)
{
    UvPlacement placement;
    std::ifstream stream(obj);
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with("mtllib ")) {
            const size_t last = line.find_last_not_of(" \r");
            takePlacement(textureFile(obj, line.substr(7, last - 6)), material, placement);
        }
    }
    return placement;
}

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
    if (json.is_object() && json.contains("materials") && json["materials"].is_array() &&
        std::any_of(json["materials"].begin(), json["materials"].end(), movesSet)) {
        throw Error(mesh, "takes its normal map's coordinates from another set by KHR_texture_transform",
                    "the set in the texture itself (texCoord)");
    }
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
