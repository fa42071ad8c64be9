#include "engine/scene/display.h"

#include <cmath>

#include <glm/common.hpp>

namespace nacre {

Image displayedImage(const Image& radiance, const Display& display)
{
    const float gain = std::exp2(display.exposureStops);
    Image picture(radiance.width, radiance.height, 3);
    for (int y = 0; y < radiance.height; ++y) {
        for (int x = 0; x < radiance.width; ++x) {
            const glm::vec3 code = displayCode(gain * radiance.rgb(x, y), display.toneCurve);
            picture.setRgb(x, y, glm::round(code * 255.0f) / 255.0f);
        }
    }
    return picture;
}

} // namespace nacre
