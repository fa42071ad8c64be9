#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "acquisition/normals/intensities.h"

namespace nacre {

// Scales are first guessed where highlights, few as they are, do not reach, and shadows, which may be many, do not
// either.
constexpr double kMiddling = 0.75;

// Pixels that know their neighbours. Observations are held as roots g = sqrt(I / q), q the pixel's bright level.
struct PixelLattice {
    int width = 0;
    int height = 0;
    int spacing = 1; // in pixels of the picture
    size_t lightCount = 0;
    size_t stride = 0;
    std::vector<int> index;       // width x height: the pixel there, -1 for none
    std::vector<uint32_t> places; // per pixel, y * width + x
    std::vector<size_t> rows;     // per pixel, its row in the intensities that the finest lattice was made of
    std::vector<float> roots;     // [pixel * stride + light], padded with zeros; no number where clipped
    std::vector<float> bright;    // per pixel, above 0
    std::vector<float> middling;  // per pixel, kMiddling's quantile over the bright level
    Intensities intensities;      // as given

    size_t pixelCount() const { return places.size(); }
    const float* rootsOf(size_t pixel) const { return &roots[pixel * stride]; }
};

// The intensities' pixels where they are in their picture; side by side where that is not known.
PixelLattice makePixelLattice(Intensities intensities, int threads);

// The same of a few thousand of them, which are spread evenly.
PixelLattice makeThinLattice(const Intensities& intensities, int threads);

// One pixel for each square of `spacing`: of those that are there the nearest to its middle, so that highlights stay
// as they are. `parents`: for each pixel its square's.
PixelLattice thinnedLattice(const PixelLattice& lattice, int spacing, int threads, std::vector<int>& parents);

// width x height: the pixel in each square or, where there is none, one that is as few steps away as any.
std::vector<int> nearestPixels(const PixelLattice& lattice);

} // namespace nacre
