#pragma once
#include <string>
#include <vector>

#include "engine/brdf/brdf_table.h"
#include "evaluation/held_out/capture_review.h"

namespace nacre {

// The lights as the object sees them, as an SVG picture: the viewer in the middle, 90 degrees from it on the rim,
// up is up. Blue: given; orange: held back, or not given.
std::string lightFigure(const std::vector<ReviewedPhotograph>& photographs);

// What share of a table's texels was measured, over its first two coordinates, as an SVG picture.
std::string coverageFigure(const BrdfTable& table);

} // namespace nacre
