#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "assets/synth/smooth_noise.h"
#include "assets/synth/target.h"

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

// Height of a few long folds that cross a piece of cloth, together of slope 1 or so, and of the wrinkles of handling.
// p in the relief's plane, which the shorter side of the picture spans from -1 to 1.
inline double foldHeight(const glm::dvec2& p, uint64_t seed)
{
    struct Fold {
        glm::dvec2 wave; // direction times angular frequency
        double phase;
        double slope;
    };
    constexpr Fold kFolds[] = {{{2.6, 1.1}, 0.4, 0.6}, {{1.4, -2.3}, 1.9, 0.4}, {{5.2, 0.9}, 2.6, 0.2}};
    double height = 0;
    for (const Fold& fold : kFolds) {
        const double bend = 0.35 * std::sin(1.7 * p.y + fold.phase);
        height += fold.slope / glm::length(fold.wave) * std::sin(glm::dot(fold.wave, p) + fold.phase + bend);
    }
    return height + 0.035 * smoothNoise(3.1 * p, seed) + 0.012 * smoothNoise(8.3 * p, seed + 1);
}

// A fabric of so many repeats a unit, whose at() answers in repeats, on folds of a slope. The fabric must live longer.
template <class Fabric> Relief inFolds(const Fabric& fabric, double repeatsPerUnit, double slope, uint64_t seed)
{
    constexpr uint64_t kFoldSeed = 77; // folds are not the yarns' own noise
    return [&fabric, repeatsPerUnit, slope, seed](const glm::dvec2& p) {
        ReliefPoint point = fabric.at(p * repeatsPerUnit);
        point.height = point.height / repeatsPerUnit + slope * foldHeight(p, seed + kFoldSeed);
        return point;
    };
}

} // namespace nacre
