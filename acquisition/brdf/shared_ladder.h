#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "acquisition/brdf/model_ladder.h"

namespace nacre {

// Several materials as combinations of the same components.
struct SharedStep {
    std::string description; // "4 components 64x12x12 R16F"
    size_t bytes = 0;        // of all materials, the basis once
    double leastPsnr = 0;    // of the material that it serves worst, as ModelJudge has it
};

struct SharedLadder {
    SharedStep apart;              // each material by its own smallest model, for comparison
    std::vector<SharedStep> steps; // by bytes, as far as they were tried
    std::optional<size_t> taken;   // empty where materials are better off apart
    std::vector<BasisBrdf> models; // one a material, where taken
};

// By tolerance: the fewest bytes in all with which every material meets it, if that is less than `apart`'s. By budget,
// a material's budget times their number: what serves the worst served best, if better than `apart`. Tables of
// different coordinates share nothing.
SharedLadder climbSharedLadder(std::span<const ModelJudge> judges, const SharedStep& apart,
                               const LadderOptions& options);

} // namespace nacre
