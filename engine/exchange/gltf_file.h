#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/exchange/lobe_model.h"

namespace nacre {

// A material of glTF 2.0 with KHR_materials_specular, _ior and _sheen; colours are linear. Textures are indices into
// GltfScene::images.
struct GltfMaterial {
    std::string name;
    glm::vec3 baseColor{1};
    float metallic = 1, roughness = 1;
    float ior = 1.5f, specular = 1;
    glm::vec3 specularColor{1};
    glm::vec3 sheenColor{0};
    float sheenRoughness = 0;
    std::optional<int> baseColorTexture{};         // sRGB, alpha: where there is an object
    std::optional<int> metallicRoughnessTexture{}; // G roughness, B metallic
    std::optional<int> normalTexture{};            // (n + 1) / 2, green up
    std::optional<int> specularTexture{};          // A
    std::optional<int> specularColorTexture{};     // sRGB
    std::optional<int> sheenColorTexture{};        // sRGB
    std::optional<int> sheenRoughnessTexture{};    // A
    bool isCut = false;                            // pixels without alpha are not there
};

// The parameters as glTF names them. Reflectances above a dielectric's 4 % become an index of refraction, so that
// specularColor stays within 1. commonIor: of several materials that share one; 0: its own.
GltfMaterial gltfMaterialOf(const std::string& name, const LobeShape& shape, const LobeColours& colours,
                            float commonIor = 0);
// Of the index of refraction whose reflectance at normal incidence is f0, at least glTF's own 1.5.
float gltfIorOf(float f0);

// Triangles, counter-clockwise from outside; metres, x right, y up, z towards the viewer.
struct GltfMesh {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents;
    std::vector<glm::vec2> uvs; // from the top left corner
    std::vector<uint32_t> indices;
};

struct GltfScene {
    std::string name;
    GltfMesh mesh{};
    GltfMaterial material{};
    std::vector<std::string> images{}; // PNG files' bytes
    float radianceScale = 1;           // what radiance of it is to be multiplied by: extras, nacre:radianceScale
};

// GLB, one binary chunk. Whole or not at all. Text that is no UTF-8 has its bad bytes replaced.
void saveGlb(const std::filesystem::path& file, const GltfScene& scene);

// A sphere about the origin.
GltfMesh sphereMesh(float radius);

} // namespace nacre
