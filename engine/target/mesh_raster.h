#pragma once
#include <memory>

#include "engine/gpu/context.h"
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
    // Of that size. Coarse: by one sample a pixel, while the mesh moves.
    Surface draw(const MeshView& view, bool isCoarse = false);

private:
    class Passes;
    std::shared_ptr<const Mesh> mesh_;
    std::unique_ptr<Passes> passes_, coarse_; // the latter once they are needed
};

} // namespace nacre
