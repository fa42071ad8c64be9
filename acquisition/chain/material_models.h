#pragma once
#include <string>
#include <vector>

#include "acquisition/brdf/bake.h"
#include "acquisition/brdf/interpolation.h"
#include "acquisition/brdf/model_ladder.h"
#include "engine/surface/surface.h"

namespace nacre {

// What a material's table is made of, and the table.
struct BakedMaterial {
    std::string name;
    BrdfInterpolant interpolant;
    BakedBrdf baked;
    glm::vec3 scale{1}; // of the table over the interpolant
};

struct ReducedMaterials {
    std::vector<Material> materials;
    std::vector<ModelLadder> ladders; // one a material; empty where the full table was asked for
};

// The materials as small as was asked for, or with their full tables.
ReducedMaterials reduceMaterials(std::vector<BakedMaterial> baked, const LadderOptions& options);

} // namespace nacre
