#pragma once
#include <functional>
#include <vector>

#include "assets/synth/bumpy_solid.h"
#include "engine/brdf/brdf_models.h"

namespace nacre {

// How light bounces between the points of a solid and into the pixels that see it. Each bounce is that of a matt
// surface of the material's albedo; between light and camera alone does a material show its own reflectance.
struct BouncingLight {
    int bounces = 0;
    std::vector<SurfaceNode> nodes;
    std::vector<glm::dvec3> materialAlbedos;
    std::vector<glm::dvec3> albedos;       // of the nodes
    std::vector<FormFactors> betweenNodes; // to each
    std::vector<FormFactors> toPixels;     // to each of the view's seen pixels
};

// The materials in patches (patchMaterial).
BouncingLight bouncingLight(const BumpySolid& solid, const SolidView& view, const std::vector<BrdfModel>& materials,
                            int bounces, int threads);

// Share of the light from all over the hemisphere that a material reflects.
glm::dvec3 meanAlbedo(const BrdfModel& material);

} // namespace nacre
