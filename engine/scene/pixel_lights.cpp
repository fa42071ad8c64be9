#include "engine/scene/pixel_lights.h"

#include "engine/surface/object_places.h"
#include "shared/lens.h"

namespace nacre {

PixelLights::PixelLights(const Surface& surface, std::span<const Light> lights, const glm::vec3& view)
    : surface_(surface), lights_(lights.begin(), lights.end()), viewpoint_(viewpointOf(surface, view))
{
    for (const Light& light : lights) {
        lookups_.push_back(horizonLookup(light.direction, surface.horizon.azimuths));
    }
    if (needsPlaces(surface, lights, view)) {
        places_ = pixelPlaces(surface);
    }
}

PixelLights::Met PixelLights::at(size_t light, size_t pixel) const
{
    if (places_.empty()) {
        return {lights_[light], visibilityOf(surface_.horizon, lookups_[light], pixel)};
    }
    const Light met = lightAt(lights_[light], places_[pixel]);
    if (surface_.horizon.empty()) {
        return {met};
    }
    const glm::vec3 direction = directionInPicture(viewpoint_, places_[pixel], met.direction);
    return {met, visibilityOf(surface_.horizon, horizonLookup(direction, surface_.horizon.azimuths), pixel)};
}

glm::vec3 PixelLights::view(size_t pixel) const
{
    return places_.empty() ? glm::vec3(viewpoint_) : viewFromPlace(viewpoint_, places_[pixel]);
}

} // namespace nacre
