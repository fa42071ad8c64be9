#pragma once
#include "engine/files/image.h"
#include "engine/surface/normal_map.h"

namespace nacre {

// The height of a map of normals whose steps are those of a thinned one: pixel (x, y) of the thinned map stands for the
// square of `spacing` pixels from (x, y) * spacing, and its height, of its own pixels, for the middle of that. Between
// its pixels the height is the normals' own.
Image fullHeight(const NormalMap& normals, const NormalMap& thinned, const Image& height, int spacing, int threads);

} // namespace nacre
