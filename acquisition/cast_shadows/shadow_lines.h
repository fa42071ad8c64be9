#pragma once
#include <vector>

#include "acquisition/cast_shadows/lit_grid.h"

namespace nacre {

// The light over `first` passes `second` lower by `rise` pixels: a shadow there tells that first stands at least so
// much higher, a lit pixel that it does not.
struct GrazingRay {
    uint32_t first = 0;
    uint32_t second = 0;
    float rise = 0; // of the grid's q
    // The shadow ends at `second`, so that the ray touches both (Kender, Smith, Shape from darkness, 1987).
    bool isEdge = false;
};

// A ray for each pixel where something else's shadow falls, from what casts it: the last lit pixel towards the light.
// None where that is beyond the object's border. `height`: q of all pixels, which near lights need to know.
std::vector<GrazingRay> shadowRays(const LitGrid& grid, size_t light, const std::vector<double>& height);

// A ray for each lit pixel, and for what stands in its light by more than half a pixel.
std::vector<GrazingRay> contradictedRays(const LitGrid& grid, size_t light, const std::vector<double>& height);

} // namespace nacre
