#pragma once
#include <array>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/brdf/brdf_models.h"

namespace nacre {

// Nodes over (sqrt(thetaH / (pi/2)), thetaD, folded phiD), as tables have them (brdf_coords.h).
inline constexpr glm::ivec3 kPriorSize{24, 12, 5};
// All that lights before a fixed camera can ask for; beyond it the border counts.
inline const TableDomain kPriorDomain{kHalfDifference, kHalfPi / 2};

// What BRDFs of materials look like, before one is measured: over the nodes, log f is normally distributed up to a
// constant that is free (Nielsen, Jensen, Ramamoorthi, On Optimal, Minimal BRDF Sampling for Reflectance Acquisition,
// 2015: principal components of a log-relative mapping). A sample of it is
//   log f = mean + components c + r,  c ~ N(0, 1),  r ~ N(0, rest).
struct MaterialPrior {
    std::vector<float> mean;       // per node
    std::vector<float> components; // [node * componentCount + component], each times its standard deviation
    std::vector<float> rest;       // per node: the variance that the components leave
    int componentCount = 0;
};

// At most so many components, and one more: the free constant.
inline constexpr int kPriorComponents = 40;

// The principal components of these materials, by their grey values. Two materials at least, none of them black.
MaterialPrior makeMaterialPrior(std::span<const BrdfModel> materials, int threads);

// Of the published ABC and SGD fits of the MERL materials (Loew et al., 2012; Bagher et al., 2012). Made once.
const MaterialPrior& publishedMaterialPrior();
std::vector<BrdfModel> publishedFits();

// The eight nodes around unit coordinates of `domain`, with their trilinear weights.
struct PriorNodes {
    std::array<size_t, 8> node;
    std::array<float, 8> weight;
};
PriorNodes priorNodesAt(const TableDomain& domain, const glm::vec3& unit);

} // namespace nacre
