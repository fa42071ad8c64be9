#pragma once
#include <vector>

#include "engine/brdf/brdf_models.h"

namespace nacre {

// A configuration and what is measured there.
struct BrdfMeasurement {
    glm::vec3 n, l, v;
    glm::vec3 f;      // 1/sr
    float weight = 1; // of the error in f: how it shows, e.g. n.l
};

// The diffuse part that fits best; A = 0.
AbcModel fitLambert(const std::vector<BrdfMeasurement>& measurements);

// Diffuse part and one ABC lobe (Loew et al. 2012): kD and A by non-negative least squares per channel, B and C by a
// search over a grid, refined. The index of refraction is fixed: thetaD alone does not determine it where lights are in
// front.
AbcModel fitLobe(const std::vector<BrdfMeasurement>& measurements);

} // namespace nacre
