#pragma once
#include <vector>

#include "acquisition/exemplar/exemplar_model.h"

namespace nacre {

// Photometric stereo by virtual exemplars: after Hertzmann and Seitz, Shape and Materials by Example, 2003, and Hui and
// Sankaranarayanan, Shape and Spatially-Varying Reflectance Estimation from Virtual Exemplars, 2017, with the object's
// own reflectance, a residual that forgets cast shadows, and candidates from neighbours in place of a search.
NormalEstimator makeExemplarEstimator(ExemplarModel model, const std::vector<Light>& lights,
                                      const NormalOptions& options);

// The same of a sample: pixels from all over the object.
NormalEstimator makeExemplarEstimator(const Intensities& sample, const std::vector<Light>& lights,
                                      const NormalOptions& options, std::vector<Finding>& findings);

} // namespace nacre
