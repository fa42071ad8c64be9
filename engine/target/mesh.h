#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/surface/normal_map.h"

namespace nacre {

// Triangles of one mesh and material of a file.
struct MeshPart {
    std::string name;
    size_t firstIndex = 0; // into Mesh::indices
    size_t indexCount = 0;
    bool hasUvs = false;
    std::shared_ptr<const NormalMap> normalMap{}; // tangent space, green up; null = none
};

// Vertices in the file's own axes (x right, y up, z towards the viewer where nothing else is asked for).
struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  // unit, or 0 where there is none
    std::vector<glm::vec2> uvs;      // v up; empty, or one a vertex
    std::vector<glm::vec4> tangents; // xyz unit or 0, w = handedness of the bitangent; empty, or one a vertex
    std::vector<uint32_t> indices;   // three a triangle
    std::vector<MeshPart> parts;     // in the order of their indices

    size_t degenerateTriangles = 0; // without an area: left out
    size_t notFiniteTriangles = 0;  // with a vertex that is no number: left out
    bool normalsWereMade = false;   // in a part at least, the file has none

    size_t triangleCount() const { return indices.size() / 3; }
};

} // namespace nacre
