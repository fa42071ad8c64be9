#pragma once
#include "engine/gpu/texture.h"
#include "engine/surface/surface.h"

namespace nacre {

// The material on a ball, lit from the upper left, exposed by itself; codes. `size` in pixels.
Image materialThumbnail(const Context& context, const Material& material, int size);

// A ball of the surface's most frequent material, to be lit as the surface is.
Surface ballSurface(const Surface& surface, int size);

} // namespace nacre
