// Mesh files that are whole, and those that are not.
#include <cstring>
#include <sstream>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/files/image.h"
#include "engine/files/measures.h"
#include "engine/target/mesh_file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/target/meshes.h"

namespace nacre::test {
namespace {
namespace fs = std::filesystem;

class MeshFileTest : public testing::Test {
protected:
    fs::path write(const std::string& name, const std::string& text)
    {
        writeText(folder_ / name, text);
        return folder_ / name;
    }
    // Without its last `bytes`.
    fs::path cut(const std::string& name, const std::string& text, size_t bytes)
    {
        return write(name, text.substr(0, text.size() - bytes));
    }

    TempFolder folder_;
};

template <class Value> std::string bytesOf(const Value& value)
{
    return std::string(reinterpret_cast<const char*>(&value), sizeof(value)); // little endian, as the machine is
}

constexpr float kCorners[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
constexpr int kTriangles[2][3] = {{0, 1, 2}, {0, 2, 3}};

std::string plyText()
{
    std::string text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                       "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    for (const auto& c : kCorners) {
        text += fmt::format("{} {} {}\n", c[0], c[1], c[2]);
    }
    for (const auto& t : kTriangles) {
        text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    }
    return text;
}

std::string plyBinary()
{
    std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                       "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";
    for (const auto& c : kCorners) {
        text += bytesOf(c);
    }
    for (const auto& t : kTriangles) {
        text += '\3' + bytesOf(t);
    }
    return text;
}

std::string stlBinary()
{
    std::string text(80, ' ');
    text += bytesOf(uint32_t{2});
    for (const auto& t : kTriangles) {
        const float normal[3] = {0, 0, 1};
        text += bytesOf(normal) + bytesOf(kCorners[t[0]]) + bytesOf(kCorners[t[1]]) + bytesOf(kCorners[t[2]]);
        text += std::string(2, '\0');
    }
    return text;
}

// One node that moves its mesh by 5 along x.
std::string gltfJson(const std::string& buffer)
{
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0,"translation":[5,0,0]}],"materials":[{"name":"clay"}],
"meshes":[{"name":"tile","primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5125,"count":6,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
"buffers":[{)" +
           buffer + R"("byteLength":72}]})";
}

std::string glb()
{
    std::string json = gltfJson("");
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::string data = bytesOf(kCorners) + bytesOf(kTriangles);
    const auto total = static_cast<uint32_t>(12 + 8 + json.size() + 8 + data.size());
    return "glTF" + bytesOf(uint32_t{2}) + bytesOf(total) + bytesOf(static_cast<uint32_t>(json.size())) + "JSON" +
           json + bytesOf(static_cast<uint32_t>(data.size())) + std::string("BIN\0", 4) + data;
}

TEST_F(MeshFileTest, EveryFormatIsReadAsTheSameSquare)
{
    write("square.bin", bytesOf(kCorners) + bytesOf(kTriangles));
    const fs::path files[] = {write("a.obj", squareObj(0, false)),
                              write("a.ply", plyText()),
                              write("b.PLY", plyBinary()),
                              write("a.stl", stlBinary()),
                              write("a.glb", glb()),
                              write("a.gltf", gltfJson(R"("uri":"square.bin",)"))};
    for (const fs::path& file : files) {
        SCOPED_TRACE(file);
        const Mesh mesh = loadMesh(file);
        EXPECT_EQ(mesh.triangleCount(), 2u);
        ASSERT_EQ(mesh.parts.size(), 1u);
        EXPECT_FALSE(mesh.parts[0].name.empty());
        for (const uint32_t index : mesh.indices) {
            EXPECT_EQ(mesh.normals[index], glm::vec3(0, 0, 1));
        }
    }
}

TEST_F(MeshFileTest, PartsAreNamedAndPlacedByTheirNodes)
{
    const Mesh mesh = loadMesh(write("a.glb", glb()));
    EXPECT_EQ(mesh.parts.at(0).name, "tile:clay");
    for (const uint32_t index : mesh.indices) {
        EXPECT_GE(mesh.positions[index].x, 5);
    }
}

TEST_F(MeshFileTest, ACutFileSaysWhatWasExpected)
{
    expectError([&] { loadMesh(cut("a.ply", plyText(), 15)); }, {"a.ply", "cut off after 1 of its 2 face"});
    expectError([&] { loadMesh(cut("b.ply", plyBinary(), 5)); }, {"b.ply", "cut off after 1 of its 2 face"});
    expectError([&] { loadMesh(cut("v.ply", plyBinary(), 30)); }, {"v.ply", "cut off after 3 of its 4 vertex"});
    expectError(
        [&] {
            loadMesh(write("s.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty "
                                    "float y\nproperty float z\nelement tristrips 1\nproperty list int int "
                                    "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n4 0 1 2 3\n"));
        },
        {"s.ply", "triangle strips", "element face"});
    expectError([&] { loadMesh(write("h.ply", "ply\nformat ascii 1.0\n")); }, {"h.ply", "header", "end_header"});
    expectError([&] { loadMesh(cut("a.stl", stlBinary(), 7)); }, {"a.stl", "cannot be read"});
    expectError([&] { loadMesh(write("t.stl", "solid x\nfacet normal 0 0 1\nouter loop\n")); },
                {"t.stl", "cannot be read"});
    expectError([&] { loadMesh(cut("a.glb", glb(), 10)); }, {"a.glb", "cannot be read"});
    expectError([&] { loadMesh(cut("a.gltf", gltfJson(R"("uri":"square.bin",)"), 20)); }, {"a.gltf", "cannot be read"});
    expectError([&] { loadMesh(cut("b.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\n", 4)); }, {"b.obj"});
    expectError([&] { loadMesh(write("e.obj", "")); }, {"e.obj", "cannot be read"});
    // The line that was cut is lost, and nothing else.
    EXPECT_EQ(loadMesh(write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3")).triangleCount(), 1u);
    write("square.bin", std::string(10, 'x'));
    expectError([&] { loadMesh(write("s.gltf", gltfJson(R"("uri":"square.bin",)"))); }, {"s.gltf"});
}

TEST_F(MeshFileTest, WhatIsNoMeshIsRefused)
{
    expectError([&] { loadMesh(folder_ / "none.obj"); }, {"none.obj", "does not exist"});
    expectError([&] { loadMesh(write("a.fbx", "x")); }, {"a.fbx", "no mesh that can be read", ".obj, .ply"});
    expectError([&] { loadMesh(write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\n")); }, {"a.obj", "no faces"});
    expectError([&] { loadMesh(write("a.ply", "nonsense\n")); }, {"a.ply", "no PLY"});
    expectError([&] { loadMesh(write("a.glb", "nonsense nonsense")); }, {"a.glb", "cannot be read"});
    expectError([&] { loadMesh(write("b.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n")); }, {"b.obj"});
}

TEST_F(MeshFileTest, UnusableTrianglesAreCountedAndLeftOut)
{
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv nan 1 0\nv 2 0 0\nv inf 1 0\n";
    const Mesh mesh = loadMesh(write("a.obj", vertices + "f 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 1 3\nf 1 3 6\n"));
    EXPECT_EQ(mesh.triangleCount(), 1u);
    EXPECT_EQ(mesh.notFiniteTriangles, 2u);
    EXPECT_EQ(mesh.degenerateTriangles, 2u);
    expectError([&] { loadMesh(write("b.obj", vertices + "f 1 2 4\nf 1 2 5\n")); },
                {"no usable face: 1 without an area, 1 with a vertex that is no number"});
}

TEST_F(MeshFileTest, ANormalMapWantsTextureCoordinates)
{
    NormalMap map(4, 4);
    std::fill(map.normals.begin(), map.normals.end(), glm::vec3(0, 0, 1));
    std::fill(map.confidence.begin(), map.confidence.end(), 1.0f);
    saveNormalMap(folder_ / "map.png", map);
    const fs::path bare = write("bare.obj", squareObj(0, false, false));
    EXPECT_EQ(loadMesh(bare).triangleCount(), 2u);
    expectError([&] { loadMesh(bare, {folder_ / "map.png"}); }, {"bare.obj", "no texture coordinates", "UVs"});
    const Mesh mapped = loadMesh(write("a.obj", squareObj(0, false)), {folder_ / "map.png"});
    EXPECT_EQ(mapped.tangents.size(), mapped.positions.size());
    expectError([&] { loadMesh(write("a.obj", squareObj(0, false)), {folder_ / "none.png"}); }, {"none.png"});
}

// A material's map is found beside the mesh.
TEST_F(MeshFileTest, MaterialsNameNormalMaps)
{
    NormalMap map(4, 4);
    std::fill(map.normals.begin(), map.normals.end(), glm::vec3(0, 0, 1));
    std::fill(map.confidence.begin(), map.confidence.end(), 1.0f);
    saveNormalMap(folder_ / "map.png", map);
    write("a.mtl", "newmtl clay\nKd 1 1 1\nmap_Kn map.png\n");
    std::string text = "mtllib a.mtl\n" + squareObj(0, false);
    text.insert(text.find("f 1"), "usemtl clay\n");
    const Mesh mesh = loadMesh(write("a.obj", text));
    ASSERT_TRUE(mesh.parts.at(0).normalMap);
    EXPECT_EQ(mesh.parts[0].normalMap->width, 4);
    EXPECT_EQ(mesh.parts[0].name, "square:clay");
}

// Corners of a cube without normals: each face keeps its own, though its vertices are shared.
TEST_F(MeshFileTest, SmoothingKeepsSharpEdges)
{
    std::string text;
    for (int i = 0; i < 8; ++i) {
        text += fmt::format("v {} {} {}\n", i & 1, i >> 1 & 1, i >> 2);
    }
    const Mesh cube =
        loadMesh(write("cube.obj", text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n"));
    ASSERT_EQ(cube.triangleCount(), 12u);
    for (size_t i = 0; i < cube.indices.size(); i += 3) {
        const glm::vec3 a = cube.positions[cube.indices[i]];
        const glm::vec3 flat = glm::normalize(
            glm::cross(cube.positions[cube.indices[i + 1]] - a, cube.positions[cube.indices[i + 2]] - a));
        for (size_t k = 0; k < 3; ++k) {
            EXPECT_LT(degreesBetween(cube.normals[cube.indices[i + k]], flat), 0.01);
        }
    }
}

double worstOfSphere(const Mesh& mesh)
{
    double worst = 0;
    for (const uint32_t index : mesh.indices) {
        worst = std::max(worst, degreesBetween(mesh.normals[index], glm::normalize(mesh.positions[index])));
    }
    return worst;
}

// Whether the file's triangles share vertices or not.
TEST_F(MeshFileTest, SmoothNormalsOfASphereAreItsOwn)
{
    const std::string obj = sphereObj(60, false);
    std::string vertices, faces;
    size_t vertexCount = 0, faceCount = 0;
    std::istringstream lines(obj);
    for (std::string line; std::getline(lines, line);) {
        if (line[0] == 'v') {
            vertices += line.substr(2) + "\n";
            ++vertexCount;
        } else if (line[0] == 'f') {
            std::istringstream words(line.substr(2));
            int a = 0, b = 0, c = 0;
            words >> a >> b >> c;
            faces += fmt::format("3 {} {} {}\n", a - 1, b - 1, c - 1);
            ++faceCount;
        }
    }
    const std::string ply = fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
                                        "property float z\nelement face {}\nproperty list uchar int vertex_indices\n"
                                        "end_header\n{}{}",
                                        vertexCount, faceCount, vertices, faces);
    // Rings of 3 degrees; next to the poles triangles on one side are larger.
    EXPECT_LT(worstOfSphere(loadMesh(write("ball.obj", obj))), 0.5);
    EXPECT_LT(worstOfSphere(loadMesh(write("ball.ply", ply))), 0.5);
}

// A square whose material has `material`, and the map's mean |x| where it is drawn with it; -1 without a map.
class MeshMapTest : public MeshFileTest {
protected:
    void SetUp() override
    {
        Image map(4, 4, 3, 0.5f);
        for (size_t i = 0; i < map.pixelCount(); ++i) {
            map.values[3 * i] = 0.8f;
            map.values[3 * i + 2] = 0.9f;
        }
        fs::create_directory(folder_ / "tex");
        for (const char* name : {"normal.png", "normal map.png", "tex/normal.png"}) {
            saveImage(folder_ / name, map, PixelType::uint8);
        }
    }
    float lean(const fs::path& file)
    {
        const Mesh mesh = loadMesh(file, {});
        return mesh.parts[0].normalMap ? mesh.parts[0].normalMap->normals[0].x : -1;
    }
    float leanOfMtl(const std::string& line)
    {
        write("m.mtl", "newmtl m\n" + line + "\n");
        return lean(write(
            "m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl m\nf 1/1 2/2 3/3\n"));
    }
    // Two sets of UVs: the corners, and half of them.
    fs::path gltf(const std::string& texture, const std::string& uri = "normal.png", const std::string& more = "")
    {
        std::string data;
        for (const float v : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f,  1.f, 0.f,  0.f, 0.f,
                              1.f, 0.f, 1.f, 1.f, 0.f, 0.f, 0.5f, 0.f, 0.5f, 0.5f}) {
            data += bytesOf(v);
        }
        write("m.bin", data);
        return write("m.gltf", fmt::format(R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}],
            "nodes": [{{"mesh": 0}}], "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1,
            "TEXCOORD_1": 2}}, "material": 0}}]}}], "materials": [{{"normalTexture": {}}}], "textures": [{{"source": 0}}],
            "images": [{{"uri": "{}"}}], "buffers": [{{"byteLength": 84, "uri": "m.bin"}}], "bufferViews": [
            {{"buffer": 0, "byteOffset": 0, "byteLength": 36}}, {{"buffer": 0, "byteOffset": 36, "byteLength": 24}},
            {{"buffer": 0, "byteOffset": 60, "byteLength": 24}}], "accessors": [
            {{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}},
            {{"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}},
            {{"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC2"}}]{}}})",
                                           texture, uri, more));
    }
};

TEST_F(MeshMapTest, MtlNamesNormalMapsInSeveralWays)
{
    const float there = leanOfMtl("map_Kn normal.png");
    EXPECT_NEAR(there, 0.6, 0.02);
    for (const char* line :
         {"norm normal.png", "map_Bump -bm 1.000000 normal.png", "map_Kn tex\\normal.png", "map_Kn Normal.PNG"}) {
        EXPECT_EQ(leanOfMtl(line), there) << line;
    }
    saveImage(folder_ / "height.png", Image(4, 4, 1, 0.5f), PixelType::uint8);
    EXPECT_EQ(leanOfMtl("map_Bump height.png"), -1);
    expectError([&] { leanOfMtl("map_Kn missing.png"); }, {"missing.png", "does not exist"});
}

TEST_F(MeshMapTest, MtlScalesAndMovesNormalMaps)
{
    const auto uvsOf = [&](const std::string& line) {
        EXPECT_GT(leanOfMtl(line), 0.5);
        return loadMesh(folder_ / "m.obj", {}).uvs;
    };
    const std::vector<glm::vec2> plain = uvsOf("norm normal.png");
    for (const char* line :
         {"norm -s 2 3 1 -o 0.25 0.5 0 normal.png", "map_Bump -bm 1 -o 0.25 0.5 0 -s 2 3 1 normal.png"}) {
        const std::vector<glm::vec2> moved = uvsOf(line);
        for (size_t i = 0; i < plain.size(); ++i) {
            EXPECT_NEAR(moved[i].x, 0.25 + 2 * plain[i].x, 1e-6) << line;
            EXPECT_NEAR(moved[i].y, 0.5 + 3 * plain[i].y, 1e-6) << line;
        }
    }
}

TEST_F(MeshMapTest, GltfScaleSetAndTransformCount)
{
    EXPECT_NEAR(lean(gltf(R"({"index": 0})")), 0.6, 0.02);
    EXPECT_NEAR(lean(gltf(R"({"index": 0})", "normal%20map.png")), 0.6, 0.02);
    EXPECT_NEAR(lean(gltf(R"({"index": 0, "scale": 0})")), 0, 1e-6);
    EXPECT_NEAR(loadMesh(gltf(R"({"index": 0})"), {}).uvs[1].x, 1, 1e-6);
    EXPECT_NEAR(loadMesh(gltf(R"({"index": 0, "texCoord": 1})"), {}).uvs[1].x, 0.5, 1e-6);
    const std::string moved =
        R"({"index": 0, "extensions": {"KHR_texture_transform": {"offset": [0.25, 0.125], "scale": [0.5, 0.25]}}})";
    const Mesh mesh = loadMesh(
        gltf(moved, "normal.png",
             R"(, "extensionsUsed": ["KHR_texture_transform"], "extensionsRequired": ["KHR_texture_transform"])"),
        {});
    const Mesh plain = loadMesh(gltf(R"({"index": 0})"), {});
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(mesh.uvs[i].x, 0.25 + 0.5 * plain.uvs[i].x, 1e-6);
        EXPECT_NEAR(1 - mesh.uvs[i].y, 0.125 + 0.25 * (1 - plain.uvs[i].y), 1e-6); // glTF counts v down
    }
}

TEST_F(MeshMapTest, SetsOfCoordinatesThatAreNotReadAreNamed)
{
    expectError([&] { lean(gltf(R"({"index": 0, "texCoord": 2})")); }, {"m.gltf", "coordinates 2"});
    expectError([&] { lean(gltf(R"({"index": 0, "extensions": {"KHR_texture_transform": {"texCoord": 1}}})")); },
                {"m.gltf", "another set"});
    EXPECT_GT(lean(gltf(R"({"index": 0, "texCoord": 1, "extensions": {"KHR_texture_transform": {"texCoord": 1}}})")),
              0.5);
}

TEST_F(MeshMapTest, RequiredExtensionsThatAreNotKnownAreNamed)
{
    for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_texture_basisu"}) {
        expectError(
            [&] {
                lean(gltf(R"({"index": 0})", "normal.png", fmt::format(R"(, "extensionsRequired": ["{}"])", name)));
            },
            {"m.gltf", name});
    }
}

} // namespace
} // namespace nacre::test
