#pragma once
#include <span>

#include "engine/files/image.h"
#include "engine/scene/ball_size.h"
#include "engine/scene/scene.h"

namespace nacre {

// Radiance of a shaded pixel by its BRDF and albedo factor alone, under a light as the pixel meets it
// (object_places.h); 0 from behind. `view` is unit, towards the viewer.
glm::vec3 brdfRadiance(const Surface& surface, size_t pixel, const Light& light, const glm::vec3& view);

// The CPU twin of shaders/direct.frag: the same shared formulas, per pixel and light one lookup of the table.
Frame renderReference(const Scene& scene, int threads = 0);

// The CPU twin of the renderer's ball path, for the view from the front: all lights, taken as distant, collapsed into
// one ball a material, of the size given for it. Code values in [0,1], n/255.
Image referenceBallPicture(const Scene& scene, std::span<const BallSize> sizes, const Display& display,
                           int threads = 0);

} // namespace nacre
