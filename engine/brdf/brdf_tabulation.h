#pragma once
#include "engine/brdf/brdf_models.h"
#include "engine/brdf/brdf_table.h"

namespace nacre {

// MERL's density with phiD folded to [0, pi/2].
inline constexpr glm::ivec3 kFullTableSize{90, 90, 90};

// f at half-difference coordinates as a folded table has it: the mean over the configurations that isotropy, mirror
// symmetry and reciprocity make equal (phiD, -phiD, phiD + pi, pi - phiD), of those that are covered.
BrdfValue foldedValue(const BrdfModel& model, const HalfDifference& coordinates);

// The model on a table's grid. Texels that the model does not cover, all whose light or view is below the horizon
// among them, have confidence 0 and their neighbours' values, so that interpolation at the border is not darkened.
BrdfTable tabulatedBrdf(const BrdfModel& model, const glm::ivec3& size = kFullTableSize,
                        const TableDomain& domain = {kHalfDifference, kHalfPi}, int threads = 0);

// Gives each texel of confidence 0 the mean of its neighbours (of six) that are nearer to the covered part.
void fillUncovered(BrdfTable& table);

} // namespace nacre
