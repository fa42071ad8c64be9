#include "engine/scene/pixel_lights.h"

#include "engine/surface/object_places.h"

namespace nacre {

PixelLights::PixelLights(const Surface& surface, std::span<const Light> lights) : surface_(surface), lights_(lights)
{
    for (const Light& light : lights) {
        lookups_.push_back(horizonLookup(light.direction, surface.horizon.azimuths));
    }
    if (anyIsNear(lights)) {
        places_ = pixelPlaces(surface);
    }
}

PixelLights::Met PixelLights::at(size_t light, size_t pixel) const
{
    const Light& base = lights_[light];
    const bool near = isNear(base);
    const Light met = near ? lightAt(base, places_[pixel]) : base;
    const glm::vec4 lookup = near ? horizonLookup(met.direction, surface_.horizon.azimuths) : lookups_[light];
    return {met, visibilityOf(surface_.horizon, lookup, pixel)};
}

} // namespace nacre
