#pragma once
#include <filesystem>
#include <string>

#include "engine/surface/surface.h"

namespace nacre {

// nacre export --gltf, --materialx and --balls: a material, or all of a surface, as parameters of other programs.
struct ParameterExport {
    std::string source;         // NAME.nacre, or any material that other commands take
    std::filesystem::path fits; // folder of published fits, or empty
    std::filesystem::path gltf, materialX, balls;
    float width = 1; // metres of the picture of a surface, of the sphere of a material
    int threads = 0;
    bool quiet = false;

    bool isAsked() const { return !gltf.empty() || !materialX.empty() || !balls.empty(); }
    // Throws usage Errors.
    void check() const;
};

// Throws Error (data) where there is no material, or one that no parameters come near.
void exportParameters(const ParameterExport& asked);

// The surface's own height, or one integrated from its normals: pixels towards the viewer.
Image exportedHeight(const Surface& surface, int threads);

} // namespace nacre
