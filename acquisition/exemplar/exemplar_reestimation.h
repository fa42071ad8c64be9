#pragma once
#include "acquisition/exemplar/exemplar_model.h"

namespace nacre {

// Adds rounds of the object's own BRDF, baked from the sample's lit observations with the normals of the round before,
// as long as that predicts held-out lights better than the round before.
void reestimate(ExemplarModel& model, const Intensities& sample, const std::vector<glm::vec3>& starts,
                const std::vector<Light>& lights, int threads, std::vector<Finding>& findings);

} // namespace nacre
