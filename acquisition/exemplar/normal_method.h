#pragma once
#include "acquisition/normals/normals.h"

namespace nacre {

// `sample`: pixels from all over the object, for methods that choose by it (auto, exemplar). auto is decided here.
NormalEstimator makeNormalEstimator(const Intensities& sample, const std::vector<Light>& lights,
                                    const NormalOptions& options, NormalReport& report);

} // namespace nacre
