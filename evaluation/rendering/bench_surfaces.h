#pragma once
#include <vector>

#include "engine/scene/picture_size.h"
#include "engine/surface/surface.h"

namespace nacre {

// What nacre bench draws: normals in every pixel, in waves, so that neighbours differ as on a real surface. As plain as
// can be: one material, no albedo factors; or with everything: four materials, factors per pixel.
Surface benchSurface(const PictureSize& size, const Material& material, bool modulated);

// Waves with the slopes of its normals, nearly: what shadows cost does not depend on where they fall.
Image wavyHeight(int width, int height);

// Lights before the surface, evenly over directions to 42 degrees off the view, each an equal part of one light. `turn`
// moves every one of them a little, so that every ball is out of date.
std::vector<Light> benchLights(int count, int turn);

// A layer of `components` for the surface, as if estimated from so many captured lights.
ResidualLayer benchResidual(const Surface& surface, int components, int captured);

} // namespace nacre
