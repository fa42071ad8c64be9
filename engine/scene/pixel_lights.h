#pragma once
#include <span>
#include <vector>

#include "engine/lights/light.h"
#include "engine/surface/surface.h"

namespace nacre {

// Lights as the pixels of a surface meet them: from their places where lights are near, past what casts shadows.
class PixelLights {
public:
    struct Met {
        Light light;
        float share = 1; // of its radiance that nothing keeps off
    };

    // Both outlive this.
    PixelLights(const Surface& surface, std::span<const Light> lights);
    size_t size() const { return lights_.size(); }
    Met at(size_t light, size_t pixel) const;

private:
    const Surface& surface_;
    std::span<const Light> lights_;
    std::vector<glm::vec4> lookups_; // horizonLookup of each
    std::vector<glm::vec3> places_;  // of the pixels, where a light is near
};

} // namespace nacre
