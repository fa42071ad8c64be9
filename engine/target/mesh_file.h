#pragma once
#include <filesystem>
#include <optional>

#include "engine/target/mesh.h"

namespace nacre {

// True for the extensions that loadMesh reads, in any case: .obj, .ply, .gltf, .glb, .stl.
bool isMeshFile(const std::filesystem::path& file);

struct MeshFileOptions {
    // For every part, in place of those that the file's materials name.
    std::filesystem::path normalMap;
    NormalY normalY = NormalY::gl;
};

// Reads a mesh, triangulated, its parts named by mesh and material. Normals that the file lacks are made smooth
// (smoothNormals); tangents are made where a normal map needs them. Throws Error (data): another extension, a file that
// ends too early or is damaged, no faces left, a normal map without texture coordinates.
Mesh loadMesh(const std::filesystem::path& file, const MeshFileOptions& options = {});

} // namespace nacre
