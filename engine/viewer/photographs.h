#pragma once
#include <atomic>
#include <functional>
#include <vector>

#include <glm/vec2.hpp>

#include "engine/view_state/verdict_picture.h"

namespace nacre {

// What a photograph shows of one pixel, beside what the surface's model says of it.
struct PixelObservation {
    size_t light = 0; // of the captured ones
    float nDotL = 0;
    float observed = 0;  // radiance over irradiance, mean of the channels
    float predicted = 0; // the same of the model
    uint8_t verdict = 0; // of kVerdictKinds
};

// The photographs that a surface was measured from, in the order of its captured lights. Who reads them is not the
// window's business. All throw Error.
struct Photographs {
    // Reads and judges them; tells the share that is done, from any thread, and stops early where asked to.
    std::function<void(const std::function<void(float)>& progress, const std::atomic<bool>& isCancelled)> load;
    // After load. Pixels of each.
    std::function<glm::ivec2()> size;
    // Linear radiance of one, 0 outside of the object.
    std::function<Image(size_t light)> picture;
    std::function<std::vector<PixelObservation>(size_t pixel)> observations;
    // On one's every pixel, as `observations` has them; kNotJudged outside of the object.
    std::function<std::vector<uint8_t>(size_t light)> verdicts;
    std::function<double()> peak; // 99th percentile of all values, which PSNR is relative to
};

} // namespace nacre
