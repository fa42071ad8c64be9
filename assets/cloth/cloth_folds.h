#pragma once
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "assets/synth/relief.h"
#include "assets/synth/smooth_noise.h"

namespace nacre {

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
