#pragma once
#include <optional>
#include <vector>

#include "engine/gpu/texture.h"
#include "engine/surface/surface.h"

namespace nacre {

inline constexpr int kThumbnailSize = 48; // pixels across

// The material on a ball, lit from the upper left, exposed by itself; codes.
Image materialThumbnail(const Context& context, const Material& material, int size = kThumbnailSize);

// A ball of the surface's most frequent material, to be lit as the surface is.
Surface ballSurface(const Surface& surface, int size);

} // namespace nacre
