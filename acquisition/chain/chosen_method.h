#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "acquisition/chain/reconciled_photographs.h"
#include "acquisition/checks/self_checks.h"
#include "acquisition/segmentation/segmentation.h"
#include "acquisition/self_light/self_light.h"

namespace nacre {

// How normals are estimated, each material by an estimator of its own.
struct ChosenMethod {
    NormalMethod method = NormalMethod::consensus; // of the material with most pixels
    std::vector<NormalEstimator> estimators;       // one a material, or one for all
    std::vector<NormalMethod> methods;             // of each
    std::vector<uint8_t> haveOneAlbedo;            // of each: whether its pixels share one
    std::vector<Finding> findings;
    std::vector<CheckFigure> figures; // of the self-checks of an object of one material
    double heldOutError = 0;          // NormalReport's, of an object of one material
    std::optional<SelfLight> self;    // what the object throws on itself; to be taken out of every block first
};

// For an object of one material. Methods that look at the whole object (auto, exemplar) do so on the sample.
ChosenMethod chooseMethod(const CaptureSample& sample, const CheckedSample& checked, const NormalOptions& options);

// Each material's estimator is made of the sample's pixels of that material alone, since methods that look at the whole
// object take it to be of one reflectance; materials that the sample has few pixels of get the whole sample's. Findings
// name their material.
ChosenMethod chooseMethod(const CaptureSample& sample, const CheckedSample& checked, const Segmentation& materials,
                          const NormalOptions& options);

// The block's observations are under `lights`; clipped ones are judged as such.
NormalBlock estimateBlock(const NormalEstimator& estimator, const Observations& block,
                          const std::vector<Light>& lights);

// Every pixel by its own material's estimator.
NormalBlock estimateBlock(const ChosenMethod& chosen, const Segmentation& materials, const Observations& block,
                          const std::vector<Light>& lights);

} // namespace nacre
