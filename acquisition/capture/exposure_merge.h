#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "acquisition/capture/capture.h"
#include "engine/files/image.h"

namespace nacre {

// How a file's values relate to radiance, and where they end.
struct ExposureScale {
    float seconds = 1;
    float fullScale = 0; // the largest code, e.g. 65535; 0 for floats, which never saturate
    float offset = 0;    // subtracted from every value; whether one is clipped is asked before

    bool isInteger() const { return fullScale > 0; }
};

// Of a pixel type as ImageHeader names it.
ExposureScale exposureScaleOf(std::string_view pixelType, double seconds);

struct MergedPixel {
    glm::vec3 radiance; // (value - offset) / seconds
    bool saturated;     // a channel was clipped in every exposure
};

// One pixel's linear values in [0, 1] (floats: any) in each exposure of a bracket to one radiance, channel by channel:
// the mean of (value - offset) / seconds with the weight seconds * hat(value), as shot noise asks for (Debevec and
// Malik, Recovering High Dynamic Range Radiance Maps from Photographs, 1997, Eq. 6, in the linear domain). Where every
// exposure is clipped, the shortest one's value stands. A single exposure is taken as it is.
MergedPixel mergeExposures(std::span<const glm::vec3> values, std::span<const ExposureScale> scales);

// Part of a photograph, its exposures merged: for spheres, which have pictures of their own.
struct MergedPhotograph {
    int x = 0; // of its top left pixel in the file
    int y = 0;
    Image radiance;                 // 3 channels
    std::vector<uint8_t> saturated; // per pixel: 1 where a channel was clipped in every exposure
};

// What the files have of the part. Throws Error where a file cannot be read, the exposures differ in size or the part
// lies outside.
MergedPhotograph loadMerged(const Photograph& photograph, const Capture& capture, const FileWindow& part);

} // namespace nacre
