#pragma once
#include <span>
#include <vector>

#include "acquisition/residual/residual_report.h"
#include "acquisition/residual/residual_rows.h"
#include "engine/scene/light.h"

namespace nacre {

// Squared errors count as radiance does in PSNR: over `peak`, clipped to [0, 1]. A half-trusted BRDF with moderate
// smoothing is what is taken unless another setting is better by more than two standard errors over the lights
// (Breiman et al., Classification and Regression Trees, 1984, section 3.4.3): few lights cannot tell settings apart.
// The BRDF has seen the lights that are left out; its errors there are raised by their leverage on normals
// (Allen, The Relationship between Variable Selection and Data Augmentation, 1974).
ResidualFit chooseResidualFit(const ResidualRows& rows, std::span<const Light> lights, float peak,
                              ResidualChoice choice);

} // namespace nacre
