#pragma once
#include <vector>

#include "acquisition/capture/observations.h"
#include "engine/lights/light.h"

namespace nacre {

// How far the sample is from Lambert's law: the root mean square of I - rho n.l over all lit observations, as a share
// of their mean, I = grey radiance over irradiance, rho n by least squares of each pixel's lit observations.
// Reflectance, cast shadows and lights that are not as they are said to be all raise it. Lit is told from the
// photographs alone, so that no fit chooses what it is judged by. NaN where nothing is lit.
double lambertianMisfit(const Observations& sample, const std::vector<Light>& lights);

} // namespace nacre
