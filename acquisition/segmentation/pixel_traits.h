#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "acquisition/capture/observations.h"
#include "acquisition/normals/normals.h"

namespace nacre {

constexpr int kLobeBins = 10;
constexpr float kLobeBinDegrees = 2; // of thetaH; the bins reach to 20 degrees

// What tells a pixel's material and neither its shape nor its light.
struct PixelTraits {
    uint32_t pixel = 0;
    glm::vec2 chromaticity{0};   // red and green of red + green + blue, of matte observations
    float chromaticityError = 0; // standard error, from the observations' own scatter
    float logAlbedo = 0;         // natural logarithm of the grey of f of matte observations, up to the capture's scale
    std::array<float, kLobeBins> lobe{}; // logarithm of f over that, in the mean of each bin of thetaH
    uint16_t lobeSeen = 0;               // bit i: some light stands in bin i
};

// Traits of a block's pixels that have a normal and enough lit observations. Lit: not in shadow, not saturated, light
// at most 78 degrees from the normal. Matte: of these the darker half in f, so that neither highlights, explained or
// not, nor their tails count; the darkest tenth is left out as well, where shadows hide.
std::vector<PixelTraits> pixelTraits(const Observations& block, const NormalBlock& normals,
                                     const std::vector<Light>& lights, int threads);

} // namespace nacre
