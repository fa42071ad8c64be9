#include "engine/files/image.h"

#include <algorithm>
#include <cmath>

#include "engine/files/measures.h"
#include "shared/shading.h"

namespace nacre {

namespace {

constexpr double kExposedQuantile = 0.99;
constexpr float kExposedLevel = 0.9f; // linear, of display white

float roundedCode(float linear)
{
    return std::round(srgbFromLinear(linear) * 255.0f) / 255.0f;
}

} // namespace

Image displayImage(const Image& radiance, float exposureStops)
{
    const float gain = std::exp2(exposureStops);
    Image display(radiance.width, radiance.height, 3);
    for (int y = 0; y < radiance.height; ++y) {
        for (int x = 0; x < radiance.width; ++x) {
            const glm::vec3 value = radiance.rgb(x, y) * gain;
            display.setRgb(x, y, {roundedCode(value.x), roundedCode(value.y), roundedCode(value.z)});
        }
    }
    return display;
}

float automaticExposure(const Image& radiance)
{
    std::vector<float> brightest;
    for (int y = 0; y < radiance.height; ++y) {
        for (int x = 0; x < radiance.width; ++x) {
            const glm::vec3 value = radiance.rgb(x, y);
            const float peak = std::max({value.x, value.y, value.z});
            if (peak > 0) {
                brightest.push_back(peak);
            }
        }
    }
    return brightest.empty() ? 0.0f : std::log2(kExposedLevel / quantile(brightest, kExposedQuantile));
}

} // namespace nacre
