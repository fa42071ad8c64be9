#pragma once
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "acquisition/capture/observations.h"
#include "engine/files/measures.h"
#include "engine/lights/light.h"

namespace nacre {

// What the sensor clipped is known to be bright and no more: no estimator looks at it.
constexpr float kClipped = std::numeric_limits<float>::quiet_NaN();
inline bool isClipped(float intensity)
{
    return std::isnan(intensity);
}

// Grey radiance over irradiance per pixel and light: what a light of irradiance 1 would show, or kClipped. Rows are
// padded with zeros to a multiple of eight.
struct Intensities {
    size_t lightCount = 0;
    size_t stride = 0;
    std::vector<float> values;
    // Where the pixels are, y * width + x, ascending; width 0: not known.
    std::vector<uint32_t> places;
    int width = 0;
    int spacing = 1; // each pixel stands for a square of so many

    size_t pixelCount() const { return stride ? values.size() / stride : 0; }
    std::span<const float> ofPixel(size_t p) const { return {&values[p * stride], lightCount}; }
    const float* padded(size_t p) const { return &values[p * stride]; }
};

Intensities makeIntensities(size_t pixels, size_t lightCount);
Intensities intensitiesOf(const Observations& block, const std::vector<Light>& lights);

// The 90th percentile of a pixel's observations that are not clipped: its own scale, which a few highlights do not
// move. 0 where there are none.
float brightLevel(std::span<const float> observed);

// The columns of the lights that are named, for leaving others out.
Intensities selectLights(const Intensities& intensities, const std::vector<size_t>& lights);

// Numbers of at most `most` pixels that are spread evenly over so many, and the rows of pixels that are named.
std::vector<size_t> spreadPixels(size_t pixels, size_t most);
Intensities selectPixels(const Intensities& intensities, const std::vector<size_t>& pixels);

} // namespace nacre
