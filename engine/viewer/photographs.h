#pragma once
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "engine/scene/image.h"

namespace nacre {

// What a photograph shows of one pixel, beside what the surface's model says of it.
struct PixelObservation {
    float nDotL = 0;
    float observed = 0;  // radiance over irradiance, mean of the channels
    float predicted = 0; // the same of the model
    std::string verdict; // used, shadow, highlight or saturated
};

// The photographs that a surface was measured from, in the order of its captured lights. Who reads them is not the
// window's business. All throw Error.
struct Photographs {
    // Reads them; tells the share that is done, and stops early where asked to.
    std::function<void(const std::function<void(float)>& progress, const std::atomic<bool>& isCancelled)> load;
    // After load. Pixels of each.
    std::function<glm::ivec2()> size;
    // Linear radiance of one, 0 outside of the object.
    std::function<Image(size_t light)> picture;
    std::function<std::vector<PixelObservation>(size_t pixel)> observations;
    std::function<double()> peak; // 99th percentile of all values, which PSNR is relative to
};

} // namespace nacre
