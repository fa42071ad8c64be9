#include "engine/target/mesh_tangents.h"

#include <cmath>
#include <unordered_map>

#include <glm/geometric.hpp>

namespace nacre {
namespace {

glm::vec3 inPlane(const glm::vec3& v, const glm::vec3& normal)
{
    return v - normal * glm::dot(normal, v);
}

glm::vec3 unitOrZero(const glm::vec3& v)
{
    const float size = glm::length(v);
    return size > 0 ? v / size : glm::vec3(0);
}

// Any unit vector across the normal.
glm::vec3 acrossNormal(const glm::vec3& n)
{
    const glm::vec3 axis = std::abs(n.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::normalize(inPlane(axis, n));
}

struct UvGradient {
    glm::vec3 tangent{0}; // unit, along which u grows; 0 where the triangle has no area in UV
    float handedness = 1; // of (tangent, direction along which v grows, normal by winding)
};

UvGradient gradientOf(const Mesh& mesh, const uint32_t* v)
{
    const glm::vec3 e1 = mesh.positions[v[1]] - mesh.positions[v[0]], e2 = mesh.positions[v[2]] - mesh.positions[v[0]];
    const glm::vec2 d1 = mesh.uvs[v[1]] - mesh.uvs[v[0]], d2 = mesh.uvs[v[2]] - mesh.uvs[v[0]];
    const float area = d1.x * d2.y - d2.x * d1.y; // signed, twice
    if (area == 0 || !std::isfinite(area)) {
        return {};
    }
    UvGradient gradient{unitOrZero((d2.y * e1 - d1.y * e2) / area), 1};
    const glm::vec3 bitangent = (d1.x * e2 - d2.x * e1) / area;
    const glm::vec3 n = mesh.normals[v[0]] + mesh.normals[v[1]] + mesh.normals[v[2]];
    gradient.handedness = glm::dot(glm::cross(n, gradient.tangent), bitangent) < 0 ? -1.0f : 1.0f;
    return gradient;
}

float angleInPlane(const Mesh& mesh, const uint32_t* v, int k)
{
    const glm::vec3& n = mesh.normals[v[k]];
    const glm::vec3 here = mesh.positions[v[k]];
    const glm::vec3 a = inPlane(mesh.positions[v[(k + 1) % 3]] - here, n);
    const glm::vec3 b = inPlane(mesh.positions[v[(k + 2) % 3]] - here, n);
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// What makes two corners one vertex of the tangent field.
struct VertexKey {
    glm::vec3 position, normal;
    glm::vec2 uv;
    float handedness;
    bool operator==(const VertexKey&) const = default;
};

struct HashOfKey {
    size_t operator()(const VertexKey& key) const
    {
        size_t hash = 0;
        const float values[] = {key.position.x, key.position.y, key.position.z, key.normal.x,  key.normal.y,
                                key.normal.z,   key.uv.x,       key.uv.y,       key.handedness};
        for (const float value : values) {
            hash = (hash ^ std::hash<float>()(value)) * 0x9e3779b97f4a7c15u;
            hash ^= hash >> 29;
        }
        return hash;
    }
};

} // namespace

void makeTangents(Mesh& mesh)
{
    Mesh welded; // of which vertices alone are filled
    std::unordered_map<VertexKey, uint32_t, HashOfKey> known;
    known.reserve(mesh.positions.size());
    std::vector<uint32_t> indices(mesh.indices.size());
    for (size_t first = 0; first < mesh.indices.size(); first += 3) {
        const uint32_t* v = &mesh.indices[first];
        const UvGradient gradient = gradientOf(mesh, v);
        for (int k = 0; k < 3; ++k) {
            const VertexKey key{mesh.positions[v[k]], mesh.normals[v[k]], mesh.uvs[v[k]], gradient.handedness};
            const auto [at, isNew] = known.try_emplace(key, static_cast<uint32_t>(welded.positions.size()));
            if (isNew) {
                welded.positions.push_back(key.position);
                welded.normals.push_back(key.normal);
                welded.uvs.push_back(key.uv);
                welded.tangents.push_back(glm::vec4(0, 0, 0, key.handedness));
            }
            const glm::vec3 tangent = unitOrZero(inPlane(gradient.tangent, key.normal));
            welded.tangents[at->second] += glm::vec4(angleInPlane(mesh, v, k) * tangent, 0);
            indices[first + k] = at->second;
        }
    }
    for (size_t i = 0; i < welded.tangents.size(); ++i) {
        glm::vec4& t = welded.tangents[i];
        const glm::vec3 unit = unitOrZero(glm::vec3(t));
        t = glm::vec4(unit == glm::vec3(0) ? acrossNormal(welded.normals[i]) : unit, t.w);
    }
    mesh.positions = std::move(welded.positions);
    mesh.normals = std::move(welded.normals);
    mesh.uvs = std::move(welded.uvs);
    mesh.tangents = std::move(welded.tangents);
    mesh.indices = std::move(indices);
}

} // namespace nacre
