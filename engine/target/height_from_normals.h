#pragma once
#include "engine/files/image.h"
#include "engine/surface/normal_map.h"

namespace nacre {

struct IntegrationOptions {
    double tolerance = 1e-5; // of the equations' residual, relative
    int mostIterations = 300;
    int threads = 0; // 0 = all
};

struct IntegratedHeight {
    Image height;      // pixels towards the viewer; mean 0 over each piece, 0 where there is no normal
    size_t pieces = 0; // of pixels that touch, whose heights against each other are not known
    int iterations = 0;
    double residual = 0; // relative
};

// The height whose slopes fit those of the normals best: least squares over pairs of neighbouring pixels with data,
// weighted by confidence and by how well normals so steep tell a slope.
IntegratedHeight heightFromNormals(const NormalMap& normals, const IntegrationOptions& options = {});

} // namespace nacre
