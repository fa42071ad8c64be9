#include "engine/target/mesh_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/files/error.h"
#include "engine/target/mesh_file_end.h"
#include "engine/target/mesh_normals.h"
#include "engine/target/mesh_tangents.h"
#include "engine/target/mesh_texture.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr const char* kReadable = ".obj, .ply, .gltf, .glb or .stl";
// A triangle's height over its longest side below which it is a line: rounding of float coordinates.
constexpr float kLeastHeight = 1e-7f;

std::string lowerExtension(const fs::path& file)
{
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

glm::vec3 vec3Of(const aiVector3D& v)
{
    return {v.x, v.y, v.z};
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

void appendVertices(const aiMesh& from, const aiMatrix4x4& toWorld, bool withUvs, Mesh& mesh)
{
    // Normals turn with the inverse transpose.
    const aiMatrix3x3 turn = aiMatrix3x3(toWorld).Inverse().Transpose();
    for (unsigned i = 0; i < from.mNumVertices; ++i) {
        mesh.positions.push_back(vec3Of(toWorld * from.mVertices[i]));
        const glm::vec3 n = from.HasNormals() ? vec3Of(turn * from.mNormals[i]) : glm::vec3(0);
        const float size = glm::length(n);
        mesh.normals.push_back(size > 0 && std::isfinite(size) ? n / size : glm::vec3(0));
        if (withUvs) {
            const glm::vec3 uv = from.HasTextureCoords(0) ? vec3Of(from.mTextureCoords[0][i]) : glm::vec3(0);
            mesh.uvs.push_back(std::isfinite(uv.x) && std::isfinite(uv.y) ? glm::vec2(uv) : glm::vec2(0));
        }
    }
}

bool isFinite(const glm::vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isDegenerate(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
{
    const glm::dvec3 ab = glm::dvec3(b) - glm::dvec3(a), ac = glm::dvec3(c) - glm::dvec3(a), bc = ac - ab;
    const double longest = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)}); // squared
    return !(glm::length(glm::cross(ab, ac)) > kLeastHeight * longest);
}

// Vertices without a place stay behind: nothing refers to them.
void appendTriangles(const fs::path& file, const aiMesh& from, size_t firstVertex, Mesh& mesh)
{
    for (unsigned f = 0; f < from.mNumFaces; ++f) {
        const aiFace& face = from.mFaces[f];
        if (face.mNumIndices != 3) {
            continue; // a point or a line
        }
        size_t v[3];
        for (int k = 0; k < 3; ++k) {
            if (face.mIndices[k] >= from.mNumVertices) {
                throw Error(file, fmt::format("names vertex {} of {}", face.mIndices[k], from.mNumVertices),
                            "faces of vertices that are there");
            }
            v[k] = firstVertex + face.mIndices[k];
        }
        const glm::vec3 &a = mesh.positions[v[0]], &b = mesh.positions[v[1]], &c = mesh.positions[v[2]];
        if (!isFinite(a) || !isFinite(b) || !isFinite(c)) {
            ++mesh.notFiniteTriangles;
        } else if (isDegenerate(a, b, c)) {
            ++mesh.degenerateTriangles;
        } else {
            for (const size_t index : v) {
                mesh.indices.push_back(static_cast<uint32_t>(index));
            }
        }
    }
}

struct Reader {
    const fs::path& file;
    const aiScene& scene;
    const MeshFileOptions& options;
    bool withUvs = false;
    Mesh mesh{};

    std::map<unsigned, std::shared_ptr<const NormalMap>> normalMaps{}; // by material

    std::shared_ptr<const NormalMap> normalMapOf(unsigned material)
    {
        const auto [at, isNew] = normalMaps.try_emplace(material);
        if (isNew) {
            NormalMap map = materialNormalMap(file, scene, *scene.mMaterials[material], options.normalY);
            at->second = map.width > 0 ? std::make_shared<const NormalMap>(std::move(map)) : nullptr;
        }
        return at->second;
    }

    void appendMesh(const aiMesh& from, const aiMatrix4x4& toWorld)
    {
        const size_t firstVertex = mesh.positions.size();
        if (firstVertex + from.mNumVertices > std::numeric_limits<uint32_t>::max()) {
            throw Error(file, "has more than 4294967295 vertices", "a smaller mesh");
        }
        MeshPart part{partName(scene, from, mesh.parts.size()), mesh.indices.size()};
        part.hasUvs = from.HasTextureCoords(0);
        appendVertices(from, toWorld, withUvs, mesh);
        appendTriangles(file, from, firstVertex, mesh);
        part.indexCount = mesh.indices.size() - part.firstIndex;
        if (part.indexCount == 0) {
            return;
        }
        if (options.normalMap.empty()) {
            part.normalMap = normalMapOf(from.mMaterialIndex);
        }
        mesh.parts.push_back(std::move(part));
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

Mesh readScene(const fs::path& file, const MeshFileOptions& options)
{
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate);
    if (!scene) {
        throw Error(file, "cannot be read: " + firstLine(importer.GetErrorString()), "a whole, undamaged mesh file");
    }
    Reader reader{file, *scene, options};
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
        reader.withUvs = reader.withUvs || scene->mMeshes[i]->HasTextureCoords(0);
    }
    if (scene->mRootNode) {
        reader.appendNode(*scene->mRootNode, aiMatrix4x4());
    }
    return std::move(reader.mesh);
}

void requireFaces(const fs::path& file, const Mesh& mesh)
{
    if (!mesh.indices.empty()) {
        return;
    }
    const size_t left = mesh.degenerateTriangles + mesh.notFiniteTriangles;
    throw Error(file,
                left == 0 ? "has no faces"
                          : fmt::format("has no usable face: {} without an area, {} with a vertex that is no number",
                                        mesh.degenerateTriangles, mesh.notFiniteTriangles),
                "a mesh with triangles or polygons");
}

void applyNormalMap(const fs::path& file, const MeshFileOptions& options, Mesh& mesh)
{
    std::shared_ptr<const NormalMap> map;
    if (!options.normalMap.empty()) {
        map = std::make_shared<const NormalMap>(loadNormalMap(options.normalMap, options.normalY));
    }
    bool mapped = false;
    for (MeshPart& part : mesh.parts) {
        part.normalMap = map ? map : part.normalMap;
        if (part.normalMap && !part.hasUvs) {
            throw Error(file, fmt::format("part '{}' has a normal map but no texture coordinates", part.name),
                        "a mesh with UVs, or no normal map");
        }
        mapped = mapped || part.normalMap;
    }
    if (mapped) {
        makeTangents(mesh);
    }
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
    requireWholeMeshFile(file);
    Mesh mesh = readScene(file, options);
    requireFaces(file, mesh);
    smoothNormals(mesh);
    applyNormalMap(file, options, mesh);
    return mesh;
}

} // namespace nacre
