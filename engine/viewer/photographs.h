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
class Photographs {
public:
    virtual ~Photographs() = default;
    // Reads and judges them; tells the share that is done, from any thread, and stops early where asked to.
    virtual void load(const std::function<void(float)>& progress, const std::atomic<bool>& isCancelled) = 0;

    // After load. Pixels of each.
    virtual glm::ivec2 size() const = 0;
    // Linear radiance of one, 0 outside of the object.
    virtual Image picture(size_t light) const = 0;
    virtual std::vector<PixelObservation> observations(size_t pixel) const = 0;
    // On one's every pixel, as `observations` has them; kNotJudged outside of the object.
    virtual std::vector<uint8_t> verdicts(size_t light) const = 0;
    // 99th percentile of all values, which PSNR is relative to.
    virtual double peak() const = 0;
};

} // namespace nacre
