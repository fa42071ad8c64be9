#pragma once
#include "acquisition/normals/normals.h"

namespace nacre {

// How far normals move, in degrees, because these photographs were taken and not others: a quarter of the photographs
// is left out four times over, and each pixel has the jackknife's standard error of what consensus makes of the rest
// (Efron, Tibshirani, An Introduction to the Bootstrap, 1993, section 11.5, groups of d). The median over the pixels;
// 90 where too few photographs are left. Errors that all photographs share do not show.
double instabilityDegrees(const Intensities& intensities, const std::vector<Light>& lights,
                          const NormalOptions& options);

} // namespace nacre
