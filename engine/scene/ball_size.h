#pragma once
#include "engine/brdf/brdf_table.h"

namespace nacre {

// How finely a material's ball has to be sampled. Radiance is computed at `radiance` texels across, per light, and
// stretched (bilinearly) to `display` texels, of which pixels read the nearest.
struct BallSize {
    int radiance = 0; // texels across; 0: none is fine enough, look the table up directly
    int display = 0;
    bool operator==(const BallSize&) const = default;
};

// The smallest sizes that keep pictures within kLeastPsnr and kLargestShare of the direct lookup's, measured on a
// sphere under lights from the front to grazing. It depends on the table alone: not on a scene's lights or its history.
BallSize measuredBallSize(const BrdfTable& table, int threads = 0);

// Texels across of a mean ball (ball.h): 1.5 of 255 takes the place of 4. 0: none of up to 512.
int measuredMeanBallSide(const BrdfTable& table, int threads = 0);

inline constexpr double kLeastPsnr = 50;       // dB, of 8-bit pictures
inline constexpr double kLargestShare = 0.001; // of pixels that are off by more than 4 of 255

} // namespace nacre
