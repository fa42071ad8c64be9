#pragma once
#include <vector>

#include "acquisition/exemplar/ball_match.h"

namespace nacre {

// Normals, albedos and the object's reflectance at once. Estimated in turn they creep along a valley, and stop wherever
// the steps become small: what the slopes of all normals do to shading a reflectance can nearly undo (Alldrin,
// Kriegman, Toward Reconstructing Surfaces with Arbitrary Isotropic Reflectance, 2007). Levenberg's and Marquardt's
// steps on the residuals of the matches, with weights that fall linearly to zero; each pixel's three unknowns are
// eliminated (Triggs, McLauchlan, Hartley, Fitzgibbon, Bundle Adjustment, 2000, section 6.1). The reflectance keeps its
// form, with w or without, and its b; it is measured on a part of the pixels, spread evenly, whose matches move along.
// Costs of matches are forgotten. The result does not depend on `threads`.
void refineJointly(const PixelLattice& lattice, int threads, MatchModel& model, std::vector<BallMatch>& matches);

} // namespace nacre
