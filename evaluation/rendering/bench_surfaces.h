#pragma once
#include <cstddef>
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

// Seconds by the wall clock, in one run.
struct BakeBenchmark {
    size_t samples = 0;
    size_t texels = 0;
    int k = 0;
    double bareQueries = 0; // k nearest of all samples for each texel by nanoflann alone, its index included
    double bake = 0;        // bakeBrdf from the same samples to the same texels
};

// A table of 90 x 90 x 180 texels from a million samples on the planes of 96 lights.
BakeBenchmark benchmarkBake(int threads);

} // namespace nacre
