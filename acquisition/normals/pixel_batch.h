#pragma once
#include <span>
#include <vector>

#include "acquisition/normals/lanes.h"

namespace nacre {

// Intensities of a few pixels side by side, so that one instruction serves all of them. Every lane is computed alone:
// results do not depend on the machine's vector width.
struct PixelBatch {
    size_t lights = 0;
    std::vector<float> values; // [light * kLanes + lane]

    explicit PixelBatch(size_t lightCount) : lights(lightCount), values(lightCount * kLanes, 0.0f) {}
    const float* ofLight(size_t light) const { return &values[light * kLanes]; }
    void set(int lane, std::span<const float> intensities)
    {
        for (size_t i = 0; i < lights; ++i) {
            values[i * kLanes + lane] = intensities[i];
        }
    }
};

// A vector of each lane.
struct BatchVector {
    float x[kLanes];
    float y[kLanes];
    float z[kLanes];
};

} // namespace nacre
