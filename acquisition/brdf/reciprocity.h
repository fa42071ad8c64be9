#pragma once
#include <optional>

#include "acquisition/brdf/interpolation.h"

namespace nacre {

// One-way samples in half-difference coordinates, where f(l, v) and f(v, l) are one.
BrdfSamples reciprocalSamples(BrdfSamples oneWay);

// Light paths can be reversed (Helmholtz), so that samples of f(l, v) tell of f(v, l) too. What was measured need not
// be reciprocal: light that bounced, a lens, polarisation, errors of measured materials. The error on held-out
// photographs (held_out_planes.h) with both apart, over that with both as one; none where too few photographs tell.
std::optional<double> errorRatioOneWay(const BrdfSamples& oneWay, const InterpolationOptions& options);

// Above, both are one: normals that are off look like matter that is not reciprocal, a little.
constexpr double kMostErrorRatioOneWay = 0.8;

} // namespace nacre
