#pragma once
#include <cstdint>

#include "engine/files/image.h"

namespace nacre {

// Turns radiance into a photograph's linear values, 1 = full scale.
struct Sensor {
    double gain = 1;   // value per unit of radiance at exposure time 1
    double noise = 0;  // standard deviation of a value, whatever the exposure time
    bool clips = true; // integer pictures stop at full scale
    uint64_t seed = 1;
};

// The photograph taken with a relative exposure time; `photograph` tells noises apart.
Image exposed(const Image& radiance, const Sensor& sensor, double seconds, uint64_t photograph);

} // namespace nacre
