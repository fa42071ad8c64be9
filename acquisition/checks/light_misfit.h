#pragma once
#include "acquisition/normals/normals.h"

namespace nacre {

// By how many degrees, in the median, the directions of the lights are off what the photographs themselves ask for. Of
// each photograph the vector is fitted that its explained observations are linear in (I / rho = n.l'); what all l' - l
// have in common as a linear function of l is what the normals could take up instead, and is left out, so that lights
// that err alike are not seen here.
double lightMisfitDegrees(const Intensities& intensities, const NormalBlock& fit, const std::vector<Light>& lights);

} // namespace nacre
