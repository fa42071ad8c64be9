#pragma once
#include <string>
#include <vector>

#include "engine/exchange/gltf_file.h"
#include "engine/surface/surface.h"

namespace nacre {

// One of a surface's materials in glTF's parameters.
struct SurfaceLobes {
    LobeShape shape;
    LobeColours colours; // of the albedo factor `most`
    float most = 1;      // albedo factors above it are cut
};

struct GltfSurfaceOptions {
    float width = 1;           // metres, of the picture
    int largestTexture = 4096; // pixels a side
    int largestGrid = 256;     // vertices a side
};

// The surface as a relief of `height` (one channel, pixels), on the rays of its camera, that a textured material
// covers. The vertices' normals look at the camera, so that the normal map has the surface's own normals; pixels
// without one are cut out. Materials are packed: each pixel has the parameters of its label. surface.materials are as
// many as `lobes`, and there is a pixel.
GltfScene gltfSurface(const Surface& surface, const Image& height, const std::vector<SurfaceLobes>& lobes,
                      const std::string& name, const GltfSurfaceOptions& options = {});

} // namespace nacre
