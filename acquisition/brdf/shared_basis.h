#pragma once
#include <span>

#include "engine/brdf/compact_brdf.h"

namespace nacre {

// A material that a basis is made for.
struct BasisMember {
    const BrdfTable* table;
    double peak = 1; // f that shows as white: in which errors count
};

// Principal components over the colour channels of several materials (Matusik et al., A Data-Driven Reflectance Model,
// 2003), about zero instead of the mean, so that black and dimmed materials are combinations too. The tables share one
// grid and domain. Errors count relative to a material's peak, beyond it less, and where nothing was measured hardly.
// One model a member, all of the same basis of at most `rank` components.
std::vector<BasisBrdf> fitBasis(std::span<const BasisMember> members, int rank);

// The same with the first `rank` components.
std::vector<BasisBrdf> truncated(std::span<const BasisBrdf> models, int rank);

} // namespace nacre
