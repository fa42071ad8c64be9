#pragma once
#include <cmath>

#include <glm/vec2.hpp>

#include "engine/files/hash_random.h"

namespace nacre {

// Value noise in [-1, 1] with a knot at every integer, its first two derivatives 0 there.

inline double knotValue(int64_t knot, uint64_t seed)
{
    return 2.0 * unitFromHash(hashOf(seed, static_cast<uint64_t>(knot))) - 1.0;
}

// From 0 to 1 as s does (Perlin, Improving Noise, 2002).
inline double smoothStep(double s)
{
    return s * s * s * (10.0 + s * (6.0 * s - 15.0));
}

inline double smoothNoise(double t, uint64_t seed)
{
    const double cell = std::floor(t);
    const int64_t knot = static_cast<int64_t>(cell);
    const double share = smoothStep(t - cell);
    return knotValue(knot, seed) * (1.0 - share) + knotValue(knot + 1, seed) * share;
}

inline double smoothNoise(const glm::dvec2& p, uint64_t seed)
{
    const double row = std::floor(p.y);
    const uint64_t knot = static_cast<uint64_t>(static_cast<int64_t>(row));
    const double share = smoothStep(p.y - row);
    return smoothNoise(p.x, hashOf(seed, knot)) * (1.0 - share) + smoothNoise(p.x, hashOf(seed, knot + 1)) * share;
}

} // namespace nacre
