#pragma once
#include "engine/brdf/compact_brdf.h"

namespace nacre {

// The table as the sum of `rank` products of a profile over thetaH and channel with a slice over (thetaD, phiD): the
// truncated singular value decomposition of the matrix whose columns are the table's slices of constant (thetaD, phiD)
// (Eckart and Young, The approximation of one matrix by another of lower rank, 1936), taken of f with rows divided
// by the square root of their own size, so that a highlight does not spend all of the rank.
LowRankTable lowRankOf(const BrdfTable& table, int rank);

// Its first `rank` products: the best approximation of that rank.
LowRankTable truncated(const LowRankTable& model, int rank);

} // namespace nacre
