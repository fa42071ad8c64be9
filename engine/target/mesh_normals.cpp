#include "engine/target/mesh_normals.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/geometric.hpp>

namespace nacre {
namespace {

constexpr float kCreaseCosine = 0.5f; // 60 degrees
// The tip of a fan: comparing each of its triangles with each takes their square, so all are smoothed into one.
constexpr size_t kLargestCompared = 256;

struct Face {
    glm::vec3 unit; // normal by winding
    float area;     // twice
};

// Corners (3 x triangle + 0, 1 or 2) in the order of the places that they touch.
struct Adjacency {
    std::vector<uint32_t> first; // of a place, into corners; one more than vertices
    std::vector<uint32_t> corners;
};

glm::vec3 cornerOf(const Mesh& mesh, size_t corner)
{
    return mesh.positions[mesh.indices[corner]];
}

Face faceOf(const Mesh& mesh, size_t triangle)
{
    const glm::dvec3 a = cornerOf(mesh, 3 * triangle);
    const glm::dvec3 cross =
        glm::cross(glm::dvec3(cornerOf(mesh, 3 * triangle + 1)) - a, glm::dvec3(cornerOf(mesh, 3 * triangle + 2)) - a);
    const double area = glm::length(cross);
    return {glm::vec3(cross / area), static_cast<float>(area)};
}

float angleAt(const Mesh& mesh, size_t corner)
{
    const size_t triangle = corner / 3 * 3, k = corner % 3;
    const glm::vec3 here = cornerOf(mesh, corner);
    const glm::vec3 a = cornerOf(mesh, triangle + (k + 1) % 3) - here,
                    b = cornerOf(mesh, triangle + (k + 2) % 3) - here;
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

Adjacency adjacencyOf(const Mesh& mesh, const std::vector<uint32_t>& places)
{
    Adjacency adjacency{std::vector<uint32_t>(mesh.positions.size() + 1, 0),
                        std::vector<uint32_t>(mesh.indices.size())};
    for (const uint32_t index : mesh.indices) {
        ++adjacency.first[places[index] + 1];
    }
    for (size_t i = 1; i < adjacency.first.size(); ++i) {
        adjacency.first[i] += adjacency.first[i - 1];
    }
    std::vector<uint32_t> next(adjacency.first.begin(), adjacency.first.end() - 1);
    for (size_t corner = 0; corner < mesh.indices.size(); ++corner) {
        adjacency.corners[next[places[mesh.indices[corner]]]++] = static_cast<uint32_t>(corner);
    }
    return adjacency;
}

// Corners that smooth over the same triangles get the same bits, since they sum in the same order.
std::vector<glm::vec3> cornerNormals(const Mesh& mesh, const Adjacency& adjacency)
{
    std::vector<glm::vec3> normals(mesh.indices.size(), glm::vec3(0));
    std::vector<Face> faces;
    std::vector<float> angles;
    for (size_t place = 0; place + 1 < adjacency.first.size(); ++place) {
        const size_t begin = adjacency.first[place], count = adjacency.first[place + 1] - begin;
        faces.clear(), angles.clear();
        for (size_t i = 0; i < count; ++i) {
            faces.push_back(faceOf(mesh, adjacency.corners[begin + i] / 3));
            angles.push_back(angleAt(mesh, adjacency.corners[begin + i]));
        }
        for (size_t i = 0; i < count; ++i) {
            glm::vec3 sum(0);
            for (size_t j = 0; j < count; ++j) {
                if (count > kLargestCompared || glm::dot(faces[i].unit, faces[j].unit) > kCreaseCosine) {
                    sum += faces[j].area * angles[j] * faces[j].unit;
                }
            }
            const float size = glm::length(sum);
            normals[adjacency.corners[begin + i]] = size > 0 ? sum / size : faces[i].unit;
        }
    }
    return normals;
}

// Index of a vertex like `from` with this normal; a new one where the vertex has another already.
uint32_t vertexWithNormal(Mesh& mesh, uint32_t from, const glm::vec3& normal)
{
    if (mesh.normals[from] == glm::vec3(0) || mesh.normals[from] == normal) {
        mesh.normals[from] = normal;
        return from;
    }
    mesh.positions.push_back(glm::vec3(mesh.positions[from]));
    mesh.normals.push_back(normal);
    if (!mesh.uvs.empty()) {
        mesh.uvs.push_back(glm::vec2(mesh.uvs[from]));
    }
    return static_cast<uint32_t>(mesh.positions.size() - 1);
}

size_t hashOf(const glm::vec3& p)
{
    uint64_t hash = 0;
    for (int k = 0; k < 3; ++k) {
        hash = (hash ^ std::bit_cast<uint32_t>(p[k] + 0.0f)) * 0x9e3779b97f4a7c15u; // -0 becomes 0
        hash ^= hash >> 32;
    }
    return hash;
}

} // namespace

std::vector<uint32_t> firstVertexAtPlace(const std::vector<glm::vec3>& positions)
{
    constexpr uint32_t kEmpty = 0xffffffffu;
    std::vector<uint32_t> slots(std::bit_ceil(2 * positions.size() + 1), kEmpty);
    std::vector<uint32_t> places(positions.size());
    for (uint32_t i = 0; i < positions.size(); ++i) {
        size_t slot = hashOf(positions[i]) & (slots.size() - 1);
        while (slots[slot] != kEmpty && positions[slots[slot]] != positions[i]) {
            slot = (slot + 1) & (slots.size() - 1);
        }
        if (slots[slot] == kEmpty) {
            slots[slot] = i;
        }
        places[i] = slots[slot];
    }
    return places;
}

void smoothNormals(Mesh& mesh)
{
    std::vector<uint8_t> wanting(mesh.triangleCount(), 0);
    for (size_t corner = 0; corner < mesh.indices.size(); ++corner) {
        wanting[corner / 3] |= mesh.normals[mesh.indices[corner]] == glm::vec3(0);
    }
    mesh.normalsWereMade = std::find(wanting.begin(), wanting.end(), 1) != wanting.end();
    if (!mesh.normalsWereMade) {
        return;
    }
    const std::vector<glm::vec3> normals = cornerNormals(mesh, adjacencyOf(mesh, firstVertexAtPlace(mesh.positions)));
    for (size_t corner = 0; corner < mesh.indices.size(); ++corner) {
        if (wanting[corner / 3]) {
            mesh.indices[corner] = vertexWithNormal(mesh, mesh.indices[corner], normals[corner]);
        }
    }
}

} // namespace nacre
