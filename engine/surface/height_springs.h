#pragma once
#include <vector>

#include "engine/surface/normal_map.h"
#include "engine/surface/spring_grid.h"

namespace nacre {

// What normals say of the height z between neighbouring pixels, as springs: the height is the minimum of the sum of
// w (z_j - z_i - rise)^2.
struct HeightSprings {
    GridSprings grid;              // w
    std::vector<double> riseRight; // of the pixel to the right over this one, in pixels
    std::vector<double> riseDown;  // of the one below
};

// By the trapezoidal rule.
HeightSprings heightSprings(const NormalMap& normals);

// The right side of the minimum's equations, whose left is the grid's.
std::vector<double> pullOf(const HeightSprings& springs);

} // namespace nacre
