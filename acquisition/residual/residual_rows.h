#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "acquisition/capture/observations.h"
#include "acquisition/residual/light_balls.h"
#include "engine/surface/surface.h"

namespace nacre {

// Radiance over irradiance of some pixels: a row a pixel and channel, 3 * pixel + channel, a column a light.
struct ResidualRows {
    std::vector<uint32_t> pixels;
    Eigen::MatrixXf observed;  // of clipped values at least what is predicted: how much more there was is not known
    Eigen::MatrixXf predicted; // by the surface's BRDF
};

// Of the block's pixels at `places`, all of which have a normal and a material. `balls` are the surface's.
ResidualRows residualRows(const Observations& block, std::span<const size_t> places, const Surface& surface,
                          const LightBalls& balls);

// Rows of what the surface's BRDF says of some pixels.
Eigen::MatrixXf predictedRows(const LightBalls& balls, std::span<const uint32_t> pixels, size_t lights);

// [pixel, channel * lights + light]: what is left of each pixel where the BRDF is trusted so far.
Eigen::MatrixXf residualsOf(const ResidualRows& rows, float trust);

// Places of the block's pixels that have a normal and a material.
std::vector<size_t> shadedPlaces(const Observations& block, const Surface& surface);

} // namespace nacre
