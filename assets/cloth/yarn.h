#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "assets/synth/relief.h"
#include "assets/synth/smooth_noise.h"

namespace nacre {

// What yarns of cloth and of knitwear have in common. `x` runs across a yarn, -1 to 1 from rim to rim.

// The upper half of the unit circle; beyond this share of the half width its tangent goes on, so that a surface of
// yarns has no holes and stays continuous.
inline double yarnSection(double x)
{
    constexpr double kRim = 0.92;
    static const double kRimHeight = std::sqrt(1.0 - kRim * kRim);
    const double beyond = std::abs(x) - kRim;
    return beyond <= 0.0 ? std::sqrt(1.0 - x * x) : kRimHeight - beyond * kRim / kRimHeight;
}

// Grooves between the plies and the fibres of a twisted yarn.
struct Twist {
    double curl;    // tangent of the angle between the fibres on the surface and the yarn: 0 = untwisted
    double depth;   // of the plies' grooves, of the yarn's half width
    double spacing; // between samples, of the yarn's half width (detailShare)
    uint64_t seed;

    // In units of the yarn's half width, as is `along`. Fibres are straight lines on the unrolled surface, a helix on
    // the yarn; both wander a little.
    double groove(double along, double x) const
    {
        constexpr double kPly = 0.62, kFibre = 0.21; // periods
        if (std::abs(x) >= 1.0) {
            return 0.0;
        }
        const double cosine = 1.0 / std::sqrt(1.0 + curl * curl);
        const double unrolled = std::asin(x) * cosine + along * curl * cosine;
        const double stray =
            0.12 * smoothNoise(0.55 * along, seed) + 0.05 * smoothNoise(2.3 * along + 3.0 * x, seed + 1);
        const double ply = std::sin(2.0 * std::numbers::pi * (unrolled + stray) / kPly);
        const double fibre = std::sin(2.0 * std::numbers::pi * (unrolled - 0.6 * stray) / kFibre +
                                      1.5 * smoothNoise(0.8 * along, seed + 2));
        return depth * (1.0 - x * x) * (ply * detailShare(kPly, spacing) + 0.35 * fibre * detailShare(kFibre, spacing));
    }
};

} // namespace nacre
