#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/scene/image.h"
#include "engine/scene/normal_map.h"

namespace nacre {

// The q-quantile (0..1) by linear interpolation between order statistics. values must not be empty; they are reordered.
float quantile(std::vector<float>& values, double q);

// PSNR [dB] of radiance: over mask pixels (mask[i] != 0), values divided by `peak` (the 99th percentile of all the
// capture's mask values), clipped to [0,1], peak 1, squared errors pooled over pixels and channels. +inf where equal.
double radiancePsnr(const Image& a, const Image& b, std::span<const uint8_t> mask, double peak);

// PSNR [dB] of 8-bit pictures whose values are code values / 255; over the mask, peak 255.
double picturePsnr(const Image& a, const Image& b, std::span<const uint8_t> mask);

struct AngularError {
    double mean = 0; // degrees
    double median = 0;
    double percentile95 = 0;
    size_t pixels = 0;  // compared
    size_t missing = 0; // in the mask without a normal: counted as 90 degrees
};

// Over mask pixels where truth has data.
AngularError angularError(const NormalMap& normals, const NormalMap& truth, std::span<const uint8_t> mask);

double degreesBetween(const glm::vec3& a, const glm::vec3& b);

} // namespace nacre
