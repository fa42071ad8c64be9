#pragma once
#include <array>
#include <memory>

#include "engine/gpu/context.h"
#include "engine/gpu/surface_textures.h"
#include "engine/surface/surface.h"
#include "engine/target/mesh.h"

namespace nacre {

// What a distant camera sees of a mesh, drawn on the device: unit normals on the side that is seen, heights in pixels,
// a label for each part (the last one takes what is beyond 255 parts). Each pixel is the mean of 2x2 samples where the
// device has room for them: of those on its nearest surface. Triangles are uploaded piece by piece.
// Throws Error where the picture is beyond the device's limits.
Surface rasterisedMesh(const Context& context, const Mesh& mesh, const MeshView& view);

// The same of one mesh again and again, in pictures of one size: what the device holds for it stays.
class MeshRaster {
public:
    MeshRaster(const Context& context, std::shared_ptr<const Mesh> mesh, int width, int height);
    ~MeshRaster();

    const std::shared_ptr<const Mesh>& mesh() const { return mesh_; }
    // Of that size; of a relief, with the labels and albedo factors of its picture. Coarse: by one sample a pixel,
    // while the mesh moves.
    Surface draw(const MeshView& view, bool isCoarse = false);
    // The same by one sample a pixel, in a picture of any size, without leaving the device: pixels of a plain surface,
    // compact ones, drawn over by the next call.
    std::shared_ptr<const PixelTextures> drawPixels(const MeshView& view);

private:
    class Samples;
    class Pixels;
    const Mesh& coarseMesh();

    const Context& context_;
    std::shared_ptr<const Mesh> mesh_;
    std::shared_ptr<const Mesh> coarseMesh_; // once it is needed
    int width_, height_;
    std::array<glm::vec3, 2> box_; // lowest and highest of the mesh's axes
    std::unique_ptr<Samples> samples_, coarse_;
    std::unique_ptr<Pixels> pixels_;
};

} // namespace nacre
