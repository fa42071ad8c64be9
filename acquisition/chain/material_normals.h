#pragma once
#include <vector>

#include "acquisition/normals/normals.h"
#include "acquisition/segmentation/segmentation.h"

namespace nacre {

// One estimator a material, each made of the sample's pixels of that material alone: methods that look at the whole
// object (auto, exemplar) take it to be of one reflectance. Materials of which the sample has few pixels get the whole
// sample's. The report has the method of the material with most pixels, and every remark with its material's name.
std::vector<NormalEstimator> estimatorsByMaterial(const Observations& sample, const Segmentation& materials,
                                                  const std::vector<Light>& lights, const NormalOptions& options,
                                                  NormalReport& report);

// Every pixel by its own material's.
NormalBlock estimateByMaterial(const std::vector<NormalEstimator>& estimators, const Segmentation& materials,
                               const Observations& block, const std::vector<Light>& lights);

} // namespace nacre
