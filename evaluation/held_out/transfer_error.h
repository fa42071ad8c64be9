#pragma once
#include <vector>

#include "acquisition/brdf/interpolation.h"
#include "engine/brdf/brdf_models.h"
#include "engine/lights/light.h"

namespace nacre {

// How well an interpolated BRDF shows its material on another shape under other lights.
struct TransferError {
    double psnr = 0;      // dB of radiance on a sphere: 99th percentile of the truth, clipped to [0, 1]
    double peakRatio = 0; // interpolated over true value at the sphere's brightest pixel
};

// `scale` brings the interpolant's units to the model's. v = (0, 0, 1); lights of irradiance 1.
TransferError transferError(const BrdfInterpolant& interpolant, const TableDomain& domain, const glm::vec3& scale,
                            const BrdfModel& truth, const std::vector<Light>& lights, int threads);

} // namespace nacre
