#pragma once
#include <vector>

#include <glm/vec2.hpp>

#include "acquisition/exemplar/pixel_lattice.h"
#include "acquisition/exemplar/reflectance.h"

namespace nacre {

// What explains a pixel: a place on the ball, and the albedo over the pixel's own bright level. The cost is the mean
// over the lights of the residual |g - sqrt(predicted)|, truncated, in units of the truncation: [0,1]. It forgets cast
// shadows and highlights that the reflectance does not know.
struct BallMatch {
    glm::vec2 texel{0};
    float scale = 1;
    float cost = 2; // beyond 1: not known
    int row = -1;
};

// The albedos that the object has, on the scale of its intensities.
struct AlbedoRange {
    float low = 0;
    float high = 1e30f; // low: all pixels have this one
};

// Residuals of roots are truncated at least here: 16 % of the brightness at the pixel's bright level, which
// calibration, interreflection and noise mostly stay below and shadows and highlights do not.
constexpr float kLeastTruncation = 0.08f;

// A reflectance that pixels are matched with.
struct MatchModel {
    Reflectance reflectance;
    ReflectanceBall ball;
    AlbedoRange albedos;
    float truncation = kLeastTruncation;
};

// The match at a row of the ball, its scale fitted from `scale` on.
BallMatch matchAtRow(const MatchModel& model, const PixelLattice& lattice, size_t pixel, int row, float scale);

// The match between the texels near `match`: at most three Gauss-Newton steps in (x, y, scale), a texel in all, on
// columns interpolated bilinearly, with residuals whose weights fall linearly to zero. The best one seen is answered.
BallMatch polishedMatch(const MatchModel& model, const PixelLattice& lattice, size_t pixel, const BallMatch& match);

// The match at a place that is known, between the texels too: its scale and cost.
BallMatch matchAtTexel(const MatchModel& model, const PixelLattice& lattice, size_t pixel, const glm::vec2& texel,
                       float scale);

// What the match predicts of every light, on the scale of the intensities. `predicted` has lightCount floats.
void predictMatch(const MatchModel& model, const BallMatch& match, float bright, float* predicted);

// After the reflectance has changed: places and scales stay, costs are not known.
void forgetCosts(std::vector<BallMatch>& matches);

double meanCost(const std::vector<BallMatch>& matches);
float medianCost(const std::vector<BallMatch>& matches);

} // namespace nacre
