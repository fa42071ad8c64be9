#pragma once
#include <glm/vec4.hpp>

#include "engine/surface/surface.h"

namespace nacre {

// Samples of shaders/mesh_view.frag (x, y of the normal, height, label + 1; 0 = nothing), samplesPerSide each way in a
// pixel, to normals, heights and labels. A pixel takes the label of its nearest sample and the mean of the samples that
// lie on the same surface; it has data where at least half of it is covered.
Surface resolvedSurface(const glm::vec4* samples, int width, int height, int samplesPerSide);

} // namespace nacre
