#include "engine/files/image.h"

#include <algorithm>
#include <cmath>

#include "engine/files/measures.h"

namespace nacre {

Image displayCodes(const Image& radiance, const Display& display)
{
    const float gain = std::exp2(display.exposureStops);
    Image codes(radiance.width, radiance.height, 3);
    for (int y = 0; y < radiance.height; ++y) {
        for (int x = 0; x < radiance.width; ++x) {
            codes.setRgb(x, y, displayCode(gain * radiance.rgb(x, y), display.toneCurve));
        }
    }
    return codes;
}

Image displayedImage(const Image& radiance, const Display& display)
{
    Image picture = displayCodes(radiance, display);
    for (float& code : picture.values) {
        code = std::round(code * 255) / 255;
    }
    return picture;
}

float automaticExposure(const Image& radiance)
{
    std::vector<uint8_t> shown(radiance.pixelCount());
    bool isBlack = true;
    for (size_t i = 0; i < shown.size(); ++i) {
        const int x = static_cast<int>(i % radiance.width), y = static_cast<int>(i / radiance.width);
        const glm::vec3 value = radiance.rgb(x, y);
        shown[i] = std::max({value.x, value.y, value.z}) > 0;
        isBlack = isBlack && !shown[i];
    }
    return isBlack ? 0.0f : exposureOfPeak(peakOf(radiance, shown));
}

} // namespace nacre
