#pragma once
#include "acquisition/brdf/model_judge.h"

namespace nacre {

// Models of one material from Lambert to its full table: fits of formulas, bivariate and full tables of falling sizes
// in each format, and components of its colour channels.
std::vector<CompactBrdf> candidateModels(const ModelJudge& judge);

// Sizes that are tried in place of `size`, the largest first.
std::vector<glm::ivec3> candidateSizes(const glm::ivec3& size);

} // namespace nacre
