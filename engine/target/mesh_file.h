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

// Reads a mesh, triangulated, its parts named by mesh and material. Where the file lacks a normal, all of its part are
// made: smooth, but over edges of more than 60 degrees. Throws Error (data): another extension, a file that Assimp
// refuses, a PLY that is cut off, no faces left, a normal map without texture coordinates. An OBJ or text STL that is
// cut off after a whole face cannot be told from a smaller one.
Mesh loadMesh(const std::filesystem::path& file, const MeshFileOptions& options = {});

} // namespace nacre
