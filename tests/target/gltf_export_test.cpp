// What saveGlb writes, as another library reads it.
#include <cmath>

#include <assimp/GltfMaterial.h>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include "engine/exchange/gltf_picture.h"
#include "engine/exchange/gltf_surface.h"
#include "engine/files/whole_file.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

// A square of pixels with two materials and a hole.
Surface twoMaterials(int side)
{
    Surface surface;
    surface.normals = NormalMap(side, side);
    surface.labels.assign(static_cast<size_t>(side) * side, 0);
    for (size_t i = 0; i < surface.labels.size(); ++i) {
        surface.labels[i] = i % side < static_cast<size_t>(side) / 2 ? 0 : 1;
        surface.normals.normals[i] = {0.6f, 0, 0.8f};
        surface.normals.confidence[i] = i == 0 ? 0.0f : 1.0f;
    }
    surface.materials.resize(2);
    surface.materials[0].name = "wood \"oak\"";
    surface.materials[1].name = "m\xc3\xa9tal <1>";
    surface.height = Image(side, side, 1, 2.0f);
    return surface;
}

const std::vector<SurfaceLobes> kLobes = {{{.roughness = 0.5f}, {glm::vec3(0.4f, 0.3f, 0.2f), glm::vec3(0.04f), {}}, 1},
                                          {{.roughness = 0.3f, .metallic = 1}, {{}, glm::vec3(0.9f), {}}, 1}};

TEST(GltfExport, AnotherLibraryReadsTheReliefItsTexturesAndParameters)
{
    const TempFolder folder;
    const Surface surface = twoMaterials(16);
    const GltfScene scene = gltfSurface(surface, surface.height, kLobes, "a \"quoted\" \xc3\xbc", {.width = 0.32f});
    saveGlb(folder / "a.glb", scene);
    Assimp::Importer importer;
    const aiScene* read = importer.ReadFile((folder / "a.glb").string(), 0);
    ASSERT_NE(read, nullptr) << importer.GetErrorString();
    ASSERT_EQ(read->mNumMeshes, 1u);
    const aiMesh& mesh = *read->mMeshes[0];
    EXPECT_STREQ(mesh.mName.C_Str(), "a \"quoted\" \xc3\xbc");
    ASSERT_EQ(mesh.mNumVertices, scene.mesh.positions.size());
    EXPECT_EQ(mesh.mNumFaces, 2u * (16 * 16 - 1)); // all cells but the hole
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        EXPECT_FLOAT_EQ(mesh.mVertices[i].x, scene.mesh.positions[i].x);
        EXPECT_FLOAT_EQ(mesh.mVertices[i].z, 2 * 0.02f); // 2 pixels of 2 cm
    }
    const aiMaterial& material = *read->mMaterials[mesh.mMaterialIndex];
    EXPECT_STREQ(material.GetName().C_Str(), "wood \"oak\", m\xc3\xa9tal <1>");
    EXPECT_EQ(read->mNumTextures, 3u); // Assimp 5.2 does not know specularColorTexture
    EXPECT_EQ(scene.images.size(), 4u);
    const TempFolder pictures;
    for (unsigned i = 0; i < read->mNumTextures; ++i) {
        const aiTexture& texture = *read->mTextures[i];
        const auto* bytes = reinterpret_cast<const unsigned char*>(texture.pcData);
        writeWholeFile(pictures / "t.png", std::span(bytes, texture.mWidth));
        EXPECT_EQ(readImageHeader(pictures / "t.png").width, 16);
    }
}

TEST(GltfExport, TexturesHoldEachLabelsParameters)
{
    const TempFolder folder;
    const Surface surface = twoMaterials(16);
    const GltfScene scene = gltfSurface(surface, surface.height, kLobes, "a");
    const auto pictureOf = [&](const std::optional<int>& texture) {
        writeTextFile(folder / "t.png", scene.images[texture.value()]);
        return loadImage(folder / "t.png");
    };
    const Image normals = pictureOf(scene.material.normalTexture),
                rough = pictureOf(scene.material.metallicRoughnessTexture),
                base = pictureOf(scene.material.baseColorTexture);
    EXPECT_NEAR(normals.at(5, 5, 0), 0.8f, 0.5 / 255 + 1e-6);
    EXPECT_NEAR(normals.at(5, 5, 2), 0.9f, 0.5 / 255 + 1e-6);
    EXPECT_NEAR(rough.at(2, 2, 1), 0.5f, 0.5 / 255 + 1e-6);
    EXPECT_NEAR(rough.at(12, 2, 1), 0.3f, 0.5 / 255 + 1e-6);
    EXPECT_EQ(rough.at(2, 2, 2), 0.0f);
    EXPECT_EQ(rough.at(12, 2, 2), 1.0f);
    EXPECT_EQ(base.at(0, 0, 3), 0.0f);
    EXPECT_EQ(base.at(1, 0, 3), 1.0f);
    // sRGB's own curve at 0.4 over the largest value, 0.9.
    EXPECT_NEAR(base.at(2, 2, 0), 1.055 * std::pow(0.4 / 0.9, 1 / 2.4) - 0.055, 0.5 / 255 + 1e-4);
    EXPECT_NEAR(scene.material.baseColor.x, 0.9f, 1e-6);
}

// Within what eight bits of roughness are at the highlight's peak, which goes by its fourth power, and of a colour.
TEST(GltfExport, ItsPictureIsTheParametersOfEachLabel)
{
    Surface surface = twoMaterials(16);
    const GltfScene scene = gltfSurface(surface, surface.height, kLobes, "a");
    const glm::vec3 n = surface.normals.normals[0], l(0.96f, 0, 0.28f), e(2, 1, 0.5f);
    const Image picture = gltfPicture(scene, surface, std::vector<Light>{{l, e}});
    for (const int label : {0, 1}) {
        const SurfaceLobes& lobes = kLobes[label];
        const glm::vec3 expected =
            e * glm::dot(n, l) * gltfModel(lobes.shape, false)->evaluate(lobes.colours, n, l, {0, 0, 1});
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(picture.rgb(label == 0 ? 2 : 12, 7)[c], expected[c], 0.035f * expected[c]) << label;
        }
    }
    EXPECT_EQ(picture.rgb(0, 0), glm::vec3(0)); // the hole
}

TEST(GltfExport, GridsAndTexturesAreBounded)
{
    const Surface surface = twoMaterials(64);
    const GltfScene scene =
        gltfSurface(surface, surface.height, kLobes, "a", {.largestTexture = 32, .largestGrid = 17});
    EXPECT_LE(scene.mesh.positions.size(), 17u * 17u);
    const TempFolder folder;
    writeTextFile(folder / "t.png", scene.images[0]);
    EXPECT_EQ(readImageHeader(folder / "t.png").width, 32);
}

TEST(GltfExport, ReflectancesAboveADielectricsBecomeAnIndexOfRefraction)
{
    const GltfMaterial material =
        gltfMaterialOf("a", {.specularWeight = 0.5f}, {glm::vec3(0.2f), {0.1f, 0.05f, 0.025f}, {}});
    const float root = (material.ior - 1) / (material.ior + 1);
    EXPECT_NEAR(root * root * material.specularColor.x * material.specular, 0.1f, 1e-5);
    EXPECT_NEAR(root * root * material.specularColor.z * material.specular, 0.025f, 1e-5);
    EXPECT_LE(material.specularColor.x, 1.0f);
    EXPECT_EQ(gltfMaterialOf("a", {}, {glm::vec3(0.2f), glm::vec3(0.04f), {}}).ior, 1.5f);
}

} // namespace
} // namespace nacre
