#pragma once
#include "engine/surface/surface.h"

namespace nacre {

// The pixels alone (normals, labels, albedo factors, residual layer; no materials) of at most `most` of the surface's
// pixels that have a normal and a material: all of them, or evenly spaced ones in reading order. Packed into a picture
// near to square.
Surface sampledPixels(const Surface& surface, size_t most);

} // namespace nacre
