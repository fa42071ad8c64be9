#pragma once
#include <filesystem>

#include "engine/brdf/brdf_models.h"
#include "engine/brdf/brdf_tabulation.h"

namespace nacre {

// Matusik et al., A Data-Driven Reflectance Model, 2003: `NAME.binary`, three int32 90 90 180, then per channel as many
// float64, phiD running fastest, then thetaD, then thetaH; f = value x (1, 1.15, 1.66) / 1500, negative = not measured.
// Cell (i, j, k) spans sqrt(thetaH / 90 deg) in [i, i+1)/90, thetaD in [j, j+1) deg, phiD in [k, k+1) deg to 180; its
// value stands for the cell's centre. Our texels stand for grid points, so both ways interpolate, and nothing is
// shifted by half a cell.

// The table is folded (the mean of phiD and 180 deg - phiD); texels that see no measured cell have confidence 0 and
// their neighbours' values. Throws Error on files of another shape, length, or with values that are no numbers.
BrdfTable loadMerl(const std::filesystem::path& file, const glm::ivec3& size = kFullTableSize);

// Samples the model at the cells' centres; where it is not covered, -1. Whole or not at all.
void saveMerl(const std::filesystem::path& file, const BrdfModel& model, int threads = 0);

} // namespace nacre
