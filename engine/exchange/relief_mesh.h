#pragma once
#include <filesystem>
#include <vector>

#include "engine/exchange/gltf_file.h"
#include "engine/surface/surface.h"

namespace nacre {

// How places of pixels (pixelPlaces) become metres from the middle of their picture, `width` of them wide.
struct PictureMetres {
    PictureMetres(const NormalMap& normals, const Image& height, float width);
    glm::vec3 of(const glm::vec3& place) const { return metres * (across * place + middle); }

    float metres;     // a pixel
    float across;     // pixels a width of the object
    glm::vec3 middle; // of places; pixels, z the height of the object's outline
};

// A surface as a mesh: a vertex for each pixel that has a normal, with that normal and its place in the picture, two
// triangles between four of them. `height` as Surface's; on the rays of the surface's camera. `width`: metres of the
// picture, whose middle is the origin. Where the height jumps, triangles join what is in front to what is behind.
GltfMesh heightMesh(Surface surface, const Image& height, float width);

// Binary PLY, or OBJ: the mesh as it is, texture coordinates from the bottom left corner. Whole or not at all. Throws
// Error.
void savePly(const std::filesystem::path& file, const GltfMesh& mesh);
void saveObj(const std::filesystem::path& file, const GltfMesh& mesh);

} // namespace nacre
