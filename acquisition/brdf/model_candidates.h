#pragma once
#include "acquisition/brdf/model_judge.h"

namespace nacre {

// Models of one material from Lambert to its full table: fits of formulas, bivariate and full tables of falling sizes
// in each format.
std::vector<CompactBrdf> candidateModels(const ModelJudge& judge);

} // namespace nacre
