#pragma once
#include <span>
#include <vector>

#include "engine/lights/light.h"
#include "engine/surface/surface.h"

namespace nacre {

// Lights and the viewer as the pixels of a surface meet them: from their places where they are near, past what casts
// shadows.
class PixelLights {
public:
    struct Met {
        Light light;
        float share = 1; // of its radiance that nothing keeps off
    };

    // The surface outlives this. `view`: direction of a distant viewer; from the front, it is the surface's camera.
    PixelLights(const Surface& surface, std::span<const Light> lights, const glm::vec3& view);
    size_t size() const { return lights_.size(); }
    Met at(size_t light, size_t pixel) const;
    // Unit, towards the viewer.
    glm::vec3 view(size_t pixel) const;

private:
    const Surface& surface_;
    std::vector<Light> lights_;
    glm::vec4 viewpoint_;
    std::vector<glm::vec4> lookups_; // horizonLookup of each
    std::vector<glm::vec3> places_;  // of the pixels, where a light or the camera is near
};

} // namespace nacre
