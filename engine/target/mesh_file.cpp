#include "engine/target/mesh_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <assimp/GltfMaterial.h>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/files/error.h"
#include "engine/files/text_files.h"
#include "engine/files/whole_file.h"
#include "engine/target/mesh_trial.h"
#include "engine/target/ply_size.h"
#include "engine/target/texture_files.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr const char* kReadable = ".obj, .ply, .gltf, .glb or .stl";
// A triangle's height over its longest side below which it is a line: rounding of float coordinates.
constexpr float kLeastHeight = 1e-7f;
constexpr float kCreaseAngle = 60; // degrees between triangles over which normals are not smoothed

glm::vec3 vec3Of(const aiVector3D& v)
{
    return {v.x, v.y, v.z};
}

bool isFinite(const aiVector3D& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Of length 1; 0 where there is no direction.
glm::vec3 unitOf(const aiVector3D& v)
{
    const float size = v.Length();
    return size > 0 && std::isfinite(size) ? vec3Of(v) / size : glm::vec3(0);
}

std::string firstLine(const std::string& text)
{
    return text.substr(0, text.find('\n'));
}

// Mesh and material, whichever the file names.
std::string partName(const aiScene& scene, const aiMesh& from, size_t index)
{
    const std::string mesh = from.mName.C_Str();
    std::string material = scene.mMaterials[from.mMaterialIndex]->GetName().C_Str();
    if (material == AI_DEFAULT_MATERIAL_NAME) {
        material.clear();
    }
    if (mesh.empty() && material.empty()) {
        return fmt::format("part {}", index + 1);
    }
    return mesh.empty() || material.empty() ? mesh + material : mesh + ":" + material;
}

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

// glTF's normalTexture.scale: of x and y.
void scaleNormals(NormalMap& map, float scale)
{
    for (size_t i = 0; i < map.normals.size(); ++i) {
        if (map.confidence[i] > 0) {
            map.normals[i] = glm::normalize(map.normals[i] * glm::vec3(scale, scale, 1));
        }
    }
}

std::shared_ptr<const NormalMap> namedNormalMap(const fs::path& mesh, const aiScene& scene, const aiString& name,
                                                NormalY normalY)
{
    const aiTexture* texture = scene.GetEmbeddedTexture(name.C_Str());
    NormalMap map =
        texture ? embeddedNormalMap(mesh, *texture, normalY) : loadNormalMap(textureFile(mesh, name.C_Str()), normalY);
    return std::make_shared<NormalMap>(std::move(map));
}

// The map_Bump of an OBJ's material is a normal map by the habit of some programs, a height map, which does not count,
// by the format.
std::shared_ptr<const NormalMap> bumpNormalMap(const fs::path& mesh, const aiMaterial& material, NormalY normalY)
{
    aiString name;
    if (material.GetTexture(aiTextureType_HEIGHT, 0, &name) != aiReturn_SUCCESS) {
        return nullptr;
    }
    try {
        return std::make_shared<const NormalMap>(loadNormalMap(textureFile(mesh, name.C_Str()), normalY));
    } catch (const Error&) {
        return nullptr;
    }
}

// The tangent-space normal map that a material names, beside the mesh or within the file; null where it names none.
std::shared_ptr<const NormalMap> materialNormalMap(const fs::path& mesh, const aiScene& scene,
                                                   const aiMaterial& material, NormalY normalY)
{
    aiString name;
    if (material.GetTexture(aiTextureType_NORMALS, 0, &name) != aiReturn_SUCCESS) {
        return bumpNormalMap(mesh, material, normalY);
    }
    const std::shared_ptr<const NormalMap> map = namedNormalMap(mesh, scene, name, normalY);
    ai_real scale = 1;
    if (material.Get(AI_MATKEY_GLTF_TEXTURE_SCALE(aiTextureType_NORMALS, 0), scale) != aiReturn_SUCCESS || scale == 1) {
        return map;
    }
    NormalMap scaled = *map;
    scaleNormals(scaled, scale);
    return std::make_shared<const NormalMap>(std::move(scaled));
}

// KHR_texture_transform, as Assimp turns it about for its v, which counts up: offset + scale * (u, 1 - v) in glTF's.
void moveUvs(const fs::path& file, const aiUVTransform& by, aiMesh& mesh)
{
    if (by.mRotation != 0) {
        throw Error(file, "turns the coordinates of its normal map (KHR_texture_transform)",
                    "a mesh whose coordinates are turned themselves");
    }
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        aiVector3D& uv = mesh.mTextureCoords[0][i];
        uv.x = by.mTranslation.x + by.mScaling.x * uv.x;
        uv.y = by.mTranslation.y + by.mScaling.y * uv.y;
    }
}

// The texture coordinates that the material's normal map lies in become the first set, which is all that is read.
void takeNormalMapsUvs(const fs::path& file, const aiScene& scene, aiMesh& mesh)
{
    int set = 0;
    aiUVTransform transform;
    const aiMaterial& material = *scene.mMaterials[mesh.mMaterialIndex];
    if (material.Get(AI_MATKEY_UVWSRC(aiTextureType_NORMALS, 0), set) == aiReturn_SUCCESS && set > 0) {
        if (set >= AI_MAX_NUMBER_OF_TEXTURECOORDS || !mesh.HasTextureCoords(static_cast<unsigned>(set))) {
            throw Error(file, fmt::format("lays its normal map into texture coordinates {}, which it lacks", set),
                        "a set of coordinates that is there");
        }
        std::swap(mesh.mTextureCoords[0], mesh.mTextureCoords[set]);
    }
    if (mesh.HasTextureCoords(0) &&
        material.Get(AI_MATKEY_UVTRANSFORM(aiTextureType_NORMALS, 0), transform) == aiReturn_SUCCESS) {
        moveUvs(file, transform, mesh);
    }
    if (mesh.HasTextureCoords(0) && lowerExtension(file) == ".obj") {
        const UvPlacement placed = mtlPlacement(file, material.GetName().C_Str());
        transform.mScaling = {placed.scale[0], placed.scale[1]};
        transform.mTranslation = {placed.offset[0], placed.offset[1]};
        moveUvs(file, transform, mesh);
    }
}

bool isDegenerate(const aiVector3D& a, const aiVector3D& b, const aiVector3D& c)
{
    const glm::dvec3 ab = vec3Of(b) - vec3Of(a), ac = vec3Of(c) - vec3Of(a), bc = ac - ab;
    const double longest = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)}); // squared
    return !(glm::length(glm::cross(ab, ac)) > kLeastHeight * longest);
}

// Whether the triangle can be drawn; counts it where it cannot.
bool isUsable(const fs::path& file, const aiMesh& mesh, const aiFace& face, Mesh& counts)
{
    if (face.mNumIndices != 3) {
        return false; // a point or a line
    }
    for (unsigned k = 0; k < 3; ++k) {
        if (face.mIndices[k] >= mesh.mNumVertices) {
            throw Error(file, fmt::format("names vertex {} of {}", face.mIndices[k], mesh.mNumVertices),
                        "faces of vertices that are there");
        }
    }
    const aiVector3D &a = mesh.mVertices[face.mIndices[0]], &b = mesh.mVertices[face.mIndices[1]],
                     &c = mesh.mVertices[face.mIndices[2]];
    const bool finite = isFinite(a) && isFinite(b) && isFinite(c), degenerate = finite && isDegenerate(a, b, c);
    counts.notFiniteTriangles += !finite;
    counts.degenerateTriangles += degenerate;
    return finite && !degenerate;
}

void drop(aiVector3D*& values)
{
    delete[] values; // as aiMesh does
    values = nullptr;
}

void pick(aiVector3D*& values, const std::vector<unsigned>& from)
{
    if (values) {
        auto* picked = new aiVector3D[from.size()];
        std::transform(from.begin(), from.end(), picked, [&](unsigned i) { return values[i]; });
        drop(values);
        values = picked;
    }
}

// Leaves the triangles that can be drawn, each with vertices of its own: where triangles share vertices Assimp takes
// the last one's normal and tangent for all. Normals stay where every vertex has one.
void separateTriangles(const fs::path& file, aiMesh& mesh, Mesh& counts)
{
    std::vector<unsigned> corners;
    unsigned kept = 0;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        if (isUsable(file, mesh, mesh.mFaces[f], counts)) {
            std::swap(mesh.mFaces[kept].mIndices, mesh.mFaces[f].mIndices);
            std::swap(mesh.mFaces[kept].mNumIndices, mesh.mFaces[f].mNumIndices);
            unsigned* indices = mesh.mFaces[kept++].mIndices;
            for (unsigned k = 0; k < 3; ++k) {
                corners.push_back(std::exchange(indices[k], static_cast<unsigned>(corners.size())));
            }
        }
    }
    const bool hasNormals = mesh.HasNormals() && std::all_of(corners.begin(), corners.end(), [&](unsigned i) {
                                return unitOf(mesh.mNormals[i]) != glm::vec3(0);
                            });
    if (!hasNormals) {
        drop(mesh.mNormals);
    }
    drop(mesh.mTangents), drop(mesh.mBitangents);
    for (aiVector3D** values : {&mesh.mVertices, &mesh.mNormals, &mesh.mTextureCoords[0]}) {
        pick(*values, corners);
    }
    mesh.mNumFaces = kept;
    mesh.mNumVertices = static_cast<unsigned>(corners.size());
    mesh.mPrimitiveTypes = kept > 0 ? aiPrimitiveType_TRIANGLE : 0;
    counts.normalsWereMade = counts.normalsWereMade || (kept > 0 && !hasNormals);
}

void appendVertices(const aiMesh& from, const aiMatrix4x4& toWorld, Mesh& mesh, bool withUvs, bool withTangents)
{
    const aiMatrix3x3 turn(toWorld);
    const aiMatrix3x3 normalTurn = aiMatrix3x3(turn).Inverse().Transpose();
    const float side = turn.Determinant() < 0 ? -1.0f : 1.0f;
    for (unsigned i = 0; i < from.mNumVertices; ++i) {
        mesh.positions.push_back(vec3Of(toWorld * from.mVertices[i]));
        mesh.normals.push_back(unitOf(normalTurn * from.mNormals[i]));
        if (withUvs) {
            const aiVector3D uv = from.HasTextureCoords(0) ? from.mTextureCoords[0][i] : aiVector3D();
            mesh.uvs.push_back(isFinite(uv) ? glm::vec2(uv.x, uv.y) : glm::vec2(0));
        }
        if (withTangents) {
            const aiVector3D t = from.mTangents ? from.mTangents[i] : aiVector3D(),
                             b = from.mBitangents ? from.mBitangents[i] : aiVector3D();
            const float handedness = (from.mNormals[i] ^ t) * b < 0 ? -side : side;
            mesh.tangents.push_back(glm::vec4(unitOf(turn * t), handedness));
        }
    }
}

struct Reader {
    const fs::path& file;
    const aiScene& scene;
    std::vector<std::shared_ptr<const NormalMap>> normalMaps; // of each material
    bool withUvs = false;
    bool withTangents = false;
    Mesh mesh{};

    void appendMesh(const aiMesh& from, const aiMatrix4x4& toWorld)
    {
        if (from.mNumFaces == 0) {
            return;
        }
        const size_t firstVertex = mesh.positions.size();
        if (firstVertex + from.mNumVertices > std::numeric_limits<uint32_t>::max()) {
            throw Error(file, "has more than 4294967295 vertices", "a smaller mesh");
        }
        mesh.parts.push_back({partName(scene, from, mesh.parts.size()), mesh.indices.size(), from.mNumVertices,
                              from.HasTextureCoords(0), normalMaps[from.mMaterialIndex]});
        const MeshPart& part = mesh.parts.back();
        if (part.normalMap && !part.hasUvs) {
            throw Error(file, fmt::format("part '{}' has a normal map but no texture coordinates", part.name),
                        "a mesh with UVs, or no normal map");
        }
        appendVertices(from, toWorld, mesh, withUvs, withTangents);
        for (size_t i = firstVertex; i < mesh.positions.size(); ++i) {
            mesh.indices.push_back(static_cast<uint32_t>(i));
        }
    }

    void appendNode(const aiNode& node, const aiMatrix4x4& above)
    {
        const aiMatrix4x4 toWorld = above * node.mTransformation;
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            appendMesh(*scene.mMeshes[node.mMeshes[i]], toWorld);
        }
        for (unsigned i = 0; i < node.mNumChildren; ++i) {
            appendNode(*node.mChildren[i], toWorld);
        }
    }
};

void requireFaces(const fs::path& file, const aiScene& scene, const Mesh& counts)
{
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
        if (scene.mMeshes[i]->mNumFaces > 0) {
            return;
        }
    }
    const size_t left = counts.degenerateTriangles + counts.notFiniteTriangles;
    throw Error(file,
                left == 0 ? "has no faces"
                          : fmt::format("has no usable face: {} without an area, {} with a vertex that is no number",
                                        counts.degenerateTriangles, counts.notFiniteTriangles),
                "a mesh with triangles or polygons");
}

// One a material: the one that was asked for, or the material's own where a part shows it.
std::vector<std::shared_ptr<const NormalMap>> loadNormalMaps(const fs::path& file, const aiScene& scene,
                                                             const MeshFileOptions& options)
{
    std::vector<std::shared_ptr<const NormalMap>> maps(scene.mNumMaterials);
    if (!options.normalMap.empty()) {
        const NormalMap map = loadNormalMap(options.normalMap, options.normalY);
        std::fill(maps.begin(), maps.end(), std::make_shared<const NormalMap>(map));
        return maps;
    }
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
        const unsigned material = scene.mMeshes[i]->mMaterialIndex;
        if (scene.mMeshes[i]->mNumFaces > 0 && !maps[material]) {
            maps[material] = materialNormalMap(file, scene, *scene.mMaterials[material], options.normalY);
        }
    }
    return maps;
}

} // namespace

bool isMeshFile(const fs::path& file)
{
    const std::string extension = lowerExtension(file);
    for (const char* known : {".obj", ".ply", ".gltf", ".glb", ".stl"}) {
        if (extension == known) {
            return true;
        }
    }
    return false;
}

Mesh loadMesh(const fs::path& file, const MeshFileOptions& options)
{
    if (!isMeshFile(file)) {
        throw Error(file, "is no mesh that can be read", kReadable);
    }
    if (!fs::is_regular_file(file)) {
        throw Error(file, fs::exists(file) ? "is no file" : "does not exist", "a mesh file");
    }
    if (lowerExtension(file) == ".ply") {
        requireWholePly(file);
    }
    if (lowerExtension(file) == ".gltf" || lowerExtension(file) == ".glb") {
        requireKnownExtensions(file);
    }
    requireHarmlessMesh(file);
    Assimp::Importer importer;
    importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, kCreaseAngle);
    const aiScene* read = importer.ReadFile(file.string(), aiProcess_Triangulate);
    if (!read) {
        throw Error(file, "cannot be read: " + firstLine(importer.GetErrorString()), "a whole, undamaged mesh file");
    }
    Reader reader{file, *read, std::vector<std::shared_ptr<const NormalMap>>(read->mNumMaterials)};
    for (unsigned i = 0; i < read->mNumMeshes; ++i) {
        takeNormalMapsUvs(file, *read, *read->mMeshes[i]);
        separateTriangles(file, *read->mMeshes[i], reader.mesh);
        reader.withUvs = reader.withUvs || read->mMeshes[i]->HasTextureCoords(0);
    }
    requireFaces(file, *read, reader.mesh);
    reader.normalMaps = loadNormalMaps(file, *read, options);
    reader.withTangents =
        std::any_of(reader.normalMaps.begin(), reader.normalMaps.end(), [](auto& map) { return map; });
    importer.ApplyPostProcessing(aiProcess_GenSmoothNormals |
                                 (reader.withTangents ? unsigned{aiProcess_CalcTangentSpace} : 0u));
    if (read->mRootNode) {
        reader.appendNode(*read->mRootNode, aiMatrix4x4());
    }
    return std::move(reader.mesh);
}

} // namespace nacre
