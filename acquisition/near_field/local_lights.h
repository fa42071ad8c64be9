#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "acquisition/near_field/near_field.h"
#include "engine/files/image.h"

namespace nacre {

// The lights as each pixel of a surface meets them, in the pixel's own frame, whose z points to the camera. Distant
// lights under an orthographic camera are the same for all pixels, and every frame is the camera's.
class LocalLights {
public:
    LocalLights(std::vector<Light> lights) : lights_(std::move(lights)) {} // distant
    // `lights` are as the origin meets them; `height` in pixels, empty: 0 everywhere.
    LocalLights(std::vector<Light> lights, NearField near, Image height, int width);

    bool areDistant() const { return !near_; }
    // As the origin meets them.
    const std::vector<Light>& reference() const { return lights_; }
    // `own` holds them where the pixel has its own.
    std::span<const Light> of(uint32_t pixel, std::vector<Light>& own) const;
    // Of these pixels alone, which are numbered from 0 from then on.
    LocalLights ofPixels(std::vector<uint32_t> pixels) const;
    // Those at the object's middle and at the corners of its outline: the widest that it meets.
    std::vector<Light> over(const Capture& capture) const;
    glm::vec3 toLocal(uint32_t pixel, const glm::vec3& inCameraFrame) const;
    glm::vec3 toCamera(uint32_t pixel, const glm::vec3& inLocalFrame) const;

private:
    LocalFrame frameOf(uint32_t pixel) const;

    std::vector<Light> lights_;
    std::optional<NearField> near_;
    Image height_;
    int width_ = 0;
    std::vector<uint32_t> pixels_; // by their number; empty: numbers are pixels
};

} // namespace nacre
