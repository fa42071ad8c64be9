#include "acquisition/near_field/local_lights.h"

#include <utility>

#include <glm/common.hpp>
#include <glm/matrix.hpp>

namespace nacre {

LocalLights::LocalLights(std::vector<Light> lights, NearField near, Image height, int width)
    : lights_(std::move(lights)), near_(std::move(near)), height_(std::move(height)), width_(width)
{
}

LocalFrame LocalLights::frameOf(uint32_t pixel) const
{
    const uint32_t place = pixels_.empty() ? pixel : pixels_[pixel];
    return frameAt(*near_, place, width_, height_.values.empty() ? 0.0f : height_.values[place]);
}

LocalLights LocalLights::ofPixels(std::vector<uint32_t> pixels) const
{
    LocalLights some = *this;
    some.pixels_ = std::move(pixels);
    return some;
}

std::span<const Light> LocalLights::of(uint32_t pixel, std::vector<Light>& own) const
{
    if (!near_) {
        return lights_;
    }
    const LocalFrame frame = frameOf(pixel);
    own.resize(lights_.size());
    for (size_t i = 0; i < own.size(); ++i) {
        own[i] = lightAt(*near_, frame, lights_[i], i);
    }
    return own;
}

std::vector<Light> LocalLights::over(const Capture& capture) const
{
    std::vector<Light> all = lights_;
    if (near_) {
        const ObjectExtent extent = extentOf(capture);
        std::vector<Light> own;
        for (const double x : {-0.5, 0.5}) {
            for (const double y : {-0.5, 0.5}) {
                const glm::dvec2 corner = glm::clamp(extent.middle + extent.width * glm::dvec2(x, y), glm::dvec2(0),
                                                     glm::dvec2(capture.width - 1, capture.height - 1));
                of(static_cast<uint32_t>(corner.y) * static_cast<uint32_t>(width_) + static_cast<uint32_t>(corner.x),
                   own);
                all.insert(all.end(), own.begin(), own.end());
            }
        }
    }
    return all;
}

glm::vec3 LocalLights::toLocal(uint32_t pixel, const glm::vec3& inCameraFrame) const
{
    return near_ ? frameOf(pixel).toLocal * inCameraFrame : inCameraFrame;
}

glm::vec3 LocalLights::toCamera(uint32_t pixel, const glm::vec3& inLocalFrame) const
{
    return near_ ? glm::transpose(frameOf(pixel).toLocal) * inLocalFrame : inLocalFrame;
}

} // namespace nacre
