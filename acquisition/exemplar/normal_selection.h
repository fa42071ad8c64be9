#pragma once
#include "acquisition/normals/normals.h"

namespace nacre {

// The method whose normals let the object's own BRDF predict held-out lights best: every sixth light is left out, each
// candidate estimates the sample's normals from the others, the BRDF is baked from its lit observations, and the
// truncated error of its predictions counts. A tie goes to the simplest Lambertian method, and to the exemplars before
// any of those.
NormalMethod selectNormalMethod(const Intensities& sample, const std::vector<Light>& lights,
                                const NormalOptions& options, std::vector<Finding>& findings);

} // namespace nacre
