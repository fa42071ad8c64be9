#pragma once
#include <optional>
#include <string>
#include <vector>

#include "acquisition/brdf/model_judge.h"

namespace nacre {

// What a model has to be good enough for. One of the two is asked for.
struct LadderOptions {
    double toleranceDecibels = 0; // the smallest model with at least this PSNR; 0: not asked
    size_t budgetBytes = 0;       // the best model of at most so many bytes; 0: not asked
    int threads = 0;

    bool isAsked() const { return toleranceDecibels > 0 || budgetBytes > 0; }
};

struct LadderStep {
    CompactBrdf model;
    std::string description; // e.g. "table 64x12x12 RGBA16F"
    size_t bytes = 0;        // coverage apart
    double psnr = 0;         // dB of radiance against the interpolant
    double nanoseconds = 0;  // of one evaluation on one core, of its own time
};

struct ModelLadder {
    std::vector<LadderStep> steps; // by bytes
    std::optional<size_t> taken;   // empty where none meets the bound: the full table stays
};

// The models from Lambert to the full table, each judged.
ModelLadder climbLadder(const ModelJudge& judge, const LadderOptions& options);

} // namespace nacre
