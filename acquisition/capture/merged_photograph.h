#pragma once
#include <cstdint>
#include <vector>

#include "acquisition/capture/capture.h"
#include "engine/files/image.h"

namespace nacre {

// A photograph as a whole, its exposures merged (exposure_merge.h): for spheres, which have pictures of their own.
struct MergedPhotograph {
    Image radiance;                 // 3 channels
    std::vector<uint8_t> saturated; // per pixel: 1 where a channel was clipped in every exposure
};

// Throws Error where a file cannot be read or the exposures differ in size.
MergedPhotograph loadMerged(const Photograph& photograph, const Capture& capture);

} // namespace nacre
