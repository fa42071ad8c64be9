#include "engine/exchange/gltf_file.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <nlohmann/json.hpp>

#include "engine/files/whole_file.h"
#include "shared/glsl.h"

namespace nacre {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFloat = 5126, kUnsignedInt = 5125;              // componentType
constexpr int kVertexData = 34962, kIndexData = 34963;         // target of a bufferView
constexpr int kLinear = 9729, kMipmaps = 9987, kClamp = 33071; // sampler
constexpr float kDielectricReflectance = 0.04f;

// JSON would show 0.1f as 0.10000000149.
double number(float x)
{
    return std::round(static_cast<double>(x) * 1e6) / 1e6;
}

Json numbers(const glm::vec3& v)
{
    return {number(v.x), number(v.y), number(v.z)};
}

// The binary chunk and the views of it.
struct Chunk {
    std::string bytes;
    Json views = Json::array(), accessors = Json::array();

    int addView(const void* data, size_t size, int target = 0)
    {
        bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
        Json view = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}};
        if (target != 0) {
            view["target"] = target;
        }
        bytes.append(static_cast<const char*>(data), size);
        views.push_back(view);
        return static_cast<int>(views.size()) - 1;
    }
    template <class T> int addAccessor(const std::vector<T>& values, const char* type, int component, int target)
    {
        const int view = addView(values.data(), values.size() * sizeof(T), target);
        accessors.push_back(
            {{"bufferView", view}, {"componentType", component}, {"count", values.size()}, {"type", type}});
        return static_cast<int>(accessors.size()) - 1;
    }
};

void setTexture(Json& to, const char* key, const std::optional<int>& texture)
{
    if (texture) {
        to[key] = {{"index", *texture}};
    }
}

Json specularOf(const GltfMaterial& material)
{
    Json specular = Json::object();
    if (material.specular != 1) {
        specular["specularFactor"] = number(material.specular);
    }
    if (material.specularColor != glm::vec3(1)) {
        specular["specularColorFactor"] = numbers(material.specularColor);
    }
    setTexture(specular, "specularTexture", material.specularTexture);
    setTexture(specular, "specularColorTexture", material.specularColorTexture);
    return specular;
}

Json extensionsOf(const GltfMaterial& material)
{
    Json extensions = Json::object();
    const Json specular = specularOf(material);
    if (!specular.empty()) {
        extensions["KHR_materials_specular"] = specular;
    }
    if (material.ior != 1.5f) {
        extensions["KHR_materials_ior"] = {{"ior", number(material.ior)}};
    }
    if (material.sheenColor != glm::vec3(0)) {
        Json sheen = {{"sheenColorFactor", numbers(material.sheenColor)},
                      {"sheenRoughnessFactor", number(material.sheenRoughness)}};
        setTexture(sheen, "sheenColorTexture", material.sheenColorTexture);
        setTexture(sheen, "sheenRoughnessTexture", material.sheenRoughnessTexture);
        extensions["KHR_materials_sheen"] = sheen;
    }
    return extensions;
}

Json jsonOf(const GltfMaterial& material)
{
    const glm::vec3& c = material.baseColor;
    Json core = {{"baseColorFactor", {number(c.x), number(c.y), number(c.z), 1}},
                 {"metallicFactor", number(material.metallic)},
                 {"roughnessFactor", number(material.roughness)}};
    setTexture(core, "baseColorTexture", material.baseColorTexture);
    setTexture(core, "metallicRoughnessTexture", material.metallicRoughnessTexture);
    Json json = {{"name", material.name}, {"pbrMetallicRoughness", core}};
    setTexture(json, "normalTexture", material.normalTexture);
    if (material.isCut) {
        json["alphaMode"] = "MASK";
    }
    const Json extensions = extensionsOf(material);
    if (!extensions.empty()) {
        json["extensions"] = extensions;
    }
    return json;
}

Json meshOf(const GltfScene& scene, Chunk& chunk)
{
    const GltfMesh& mesh = scene.mesh;
    Json attributes;
    attributes["POSITION"] = chunk.addAccessor(mesh.positions, "VEC3", kFloat, kVertexData);
    glm::vec3 least(mesh.positions.front()), most = least;
    for (const glm::vec3& p : mesh.positions) {
        least = glm::min(least, p), most = glm::max(most, p);
    }
    chunk.accessors.back()["min"] = {least.x, least.y, least.z};
    chunk.accessors.back()["max"] = {most.x, most.y, most.z};
    attributes["NORMAL"] = chunk.addAccessor(mesh.normals, "VEC3", kFloat, kVertexData);
    if (!scene.images.empty()) {
        attributes["TANGENT"] = chunk.addAccessor(mesh.tangents, "VEC4", kFloat, kVertexData);
        attributes["TEXCOORD_0"] = chunk.addAccessor(mesh.uvs, "VEC2", kFloat, kVertexData);
    }
    const int indices = chunk.addAccessor(mesh.indices, "SCALAR", kUnsignedInt, kIndexData);
    const Json primitive = {{"attributes", attributes}, {"indices", indices}, {"material", 0}};
    return {{"name", scene.name}, {"primitives", Json::array({primitive})}};
}

void addImages(const GltfScene& scene, Chunk& chunk, Json& root)
{
    for (size_t i = 0; i < scene.images.size(); ++i) {
        const std::string& png = scene.images[i];
        root["images"].push_back({{"bufferView", chunk.addView(png.data(), png.size())}, {"mimeType", "image/png"}});
        root["textures"].push_back({{"sampler", 0}, {"source", i}});
    }
    if (!scene.images.empty()) {
        const Json sampler = {{"magFilter", kLinear}, {"minFilter", kMipmaps}, {"wrapS", kClamp}, {"wrapT", kClamp}};
        root["samplers"] = Json::array({sampler});
    }
}

Json rootOf(const GltfScene& scene, Chunk& chunk)
{
    Json root = {{"asset", {{"version", "2.0"}, {"generator", "nacre"}}}, {"scene", 0}};
    Json view = {{"name", scene.name}, {"nodes", Json::array({0})}};
    if (scene.radianceScale != 1) {
        view["extras"] = {{"nacre:radianceScale", number(scene.radianceScale)}};
    }
    root["scenes"] = Json::array({view});
    root["nodes"] = Json::array({Json{{"name", scene.name}, {"mesh", 0}}});
    root["meshes"] = Json::array({meshOf(scene, chunk)});
    root["materials"] = Json::array({jsonOf(scene.material)});
    const Json extensions = extensionsOf(scene.material);
    for (const auto& [name, value] : extensions.items()) {
        root["extensionsUsed"].push_back(name);
    }
    addImages(scene, chunk, root);
    root["bufferViews"] = chunk.views;
    root["accessors"] = chunk.accessors;
    root["buffers"] = Json::array({Json{{"byteLength", (chunk.bytes.size() + 3) / 4 * 4}}});
    return root;
}

void append(std::string& bytes, uint32_t value)
{
    for (int i = 0; i < 4; ++i) { // little endian
        bytes.push_back(static_cast<char>(value >> (8 * i) & 0xff));
    }
}

void appendChunk(std::string& bytes, const char* type, std::string content, char padding)
{
    content.resize((content.size() + 3) / 4 * 4, padding);
    append(bytes, static_cast<uint32_t>(content.size()));
    bytes.append(type, 4);
    bytes += content;
}

float largest(const glm::vec3& v)
{
    return std::max({v.x, v.y, v.z});
}

} // namespace

float gltfIorOf(float f0)
{
    if (f0 <= kDielectricReflectance + 1e-6f) {
        return 1.5f;
    }
    const float root = std::sqrt(std::min(f0, 0.98f));
    return (1 + root) / (1 - root);
}

GltfMaterial gltfMaterialOf(const std::string& name, const LobeShape& shape, const LobeColours& colours,
                            float commonIor)
{
    GltfMaterial material{.name = name, .roughness = shape.roughness};
    material.sheenColor = colours.sheen;
    material.sheenRoughness = colours.sheen == glm::vec3(0) ? 0 : shape.sheenRoughness;
    if (shape.isMetal()) {
        material.baseColor = colours.specular;
        material.metallic = shape.metallic;
        material.ior = commonIor > 0 ? commonIor : 1.5f;
        const float root = (material.ior - 1) / (material.ior + 1);
        if (material.ior != 1.5f) {
            material.specularColor = glm::vec3(kDielectricReflectance / (root * root));
        }
        return material;
    }
    const glm::vec3 f0 = shape.specularWeight > 0 ? colours.specular / shape.specularWeight : glm::vec3(0);
    material.metallic = 0;
    material.baseColor = colours.diffuse;
    material.specular = shape.specularWeight;
    material.ior = commonIor > 0 ? commonIor : gltfIorOf(largest(f0));
    const float root = (material.ior - 1) / (material.ior + 1);
    material.specularColor = glm::min(f0 / (root * root), glm::vec3(1));
    if (glm::all(glm::lessThan(glm::abs(material.specularColor - 1.0f), glm::vec3(1e-4f)))) {
        material.specularColor = glm::vec3(1);
    }
    return material;
}

void saveGlb(const std::filesystem::path& file, const GltfScene& scene)
{
    Chunk chunk;
    const Json root = rootOf(scene, chunk);
    std::string chunks;
    appendChunk(chunks, "JSON", root.dump(-1, ' ', false, Json::error_handler_t::replace), ' ');
    appendChunk(chunks, "BIN\0", std::move(chunk.bytes), '\0');
    constexpr uint32_t kHeader = 12, kVersion = 2;
    std::string bytes = "glTF";
    append(bytes, kVersion);
    append(bytes, kHeader + static_cast<uint32_t>(chunks.size()));
    bytes += chunks;
    writeWholeFile(file, {reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
}

GltfMesh sphereMesh(float radius)
{
    constexpr int kAround = 96, kDown = 48;
    GltfMesh mesh;
    for (int j = 0; j <= kDown; ++j) {
        for (int i = 0; i <= kAround; ++i) {
            const float phi = 2 * kPi * static_cast<float>(i) / kAround, theta = kPi * static_cast<float>(j) / kDown;
            const glm::vec3 n(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
            mesh.positions.push_back(radius * n);
            mesh.normals.push_back(n);
            mesh.tangents.emplace_back(std::cos(phi), 0, -std::sin(phi), 1);
            mesh.uvs.emplace_back(static_cast<float>(i) / kAround, static_cast<float>(j) / kDown);
        }
    }
    const auto at = [](int i, int j) { return static_cast<uint32_t>(j * (kAround + 1) + i); };
    for (int j = 0; j < kDown; ++j) {
        for (int i = 0; i < kAround; ++i) {
            if (j > 0) {
                mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i, j + 1), at(i + 1, j)});
            }
            if (j + 1 < kDown) {
                mesh.indices.insert(mesh.indices.end(), {at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
            }
        }
    }
    return mesh;
}

} // namespace nacre
