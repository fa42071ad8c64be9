#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "acquisition/chain/material_models.h"

namespace nacre {

// Materials reduced together, and the surface that holds them: a ball of each, in rows.
struct PackedLibrary {
    Surface surface;
    std::vector<ModelLadder> ladders; // one a material, as ReducedMaterials has them
    SharedLadder shared;
    size_t fullBytes = 0; // of their tables as RGBA32F
};

// Formulas are tabulated as an acquisition's tables are. Throws Error about any that cannot be used, usage where they
// are more than a surface's labels can name.
PackedLibrary packedLibrary(const std::vector<std::string>& specifications, const std::filesystem::path& fitsFolder,
                            const LadderOptions& options);

} // namespace nacre
