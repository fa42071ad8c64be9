#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/files/image.h"

namespace nacre {

// The q-quantile (0..1) by linear interpolation between order statistics. values must not be empty; they are reordered.
float quantile(std::vector<float>& values, double q);

// PSNR [dB] of radiance: over mask pixels (mask[i] != 0), values divided by `peak` (the 99th percentile of all the
// capture's mask values), clipped to [0,1], peak 1, squared errors pooled over pixels and channels. +inf where equal.
double radiancePsnr(const Image& a, const Image& b, std::span<const uint8_t> mask, double peak);

// PSNR [dB] of 8-bit pictures whose values are code values / 255; over the mask, peak 255.
double picturePsnr(const Image& a, const Image& b, std::span<const uint8_t> mask);

double degreesBetween(const glm::vec3& a, const glm::vec3& b);

} // namespace nacre
