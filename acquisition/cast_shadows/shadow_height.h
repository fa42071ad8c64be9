#pragma once
#include <span>

#include "acquisition/cast_shadows/lit_grid.h"
#include "engine/files/image.h"

namespace nacre {

// The height q (pixels towards the viewer) that fits the grid's normals and the shadows that the lights `by` cast on
// it. Normals say nothing of steps, where one thing stands before another; shadows do. Like the normals' own height it
// is the least sum of squares over springs (height_springs.h), of which there are more: one for each ray that touches
// two pixels, or contradicts a state. A spring that is stretched beyond reason gives way, be it of a step in the height
// or of a wrong state: iteratively reweighted least squares with Cauchy's weights 1 / (1 + (r / s)^2) (Holland, Welsch,
// Robust regression using iteratively reweighted least-squares, 1977).
Image heightFromShadows(const LitGrid& grid, std::span<const size_t> by, int threads);

} // namespace nacre
