#pragma once
#include <span>
#include <vector>

#include "engine/surface/surface.h"

namespace nacre {

// The surface's BRDFs under each of its captured lights, as reference balls (shaders/shared/ball.h): with the view from
// the front, a ball answers all pixels of a material. They save time where pixels outnumber a ball's texels.
class LightBalls {
public:
    // `size`: texels across, at least 2; 0: no balls, each pixel asks its table. The surface is referred to.
    LightBalls(const Surface& surface, int size, int threads);

    // Radiance over irradiance of a shaded pixel under all lights: [channel * lights + light].
    void predict(size_t pixel, std::span<float> predicted) const;

private:
    void addTexel(const float* texel, float share, const glm::vec3& albedo, std::span<float> predicted) const;

    const Surface& surface_;
    int size_;
    std::vector<std::vector<float>> materials_; // [texel * 3 * lights + channel * lights + light]
};

} // namespace nacre
