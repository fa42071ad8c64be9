#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>

namespace nacre {

// Random numbers that depend on their keys alone: the same for any order of evaluation, and for any library.

constexpr uint64_t kHashStep = 0x9e3779b97f4a7c15u;

// SplitMix64's finaliser (Steele, Lea, Flood, Fast Splittable Pseudorandom Number Generators, 2014).
inline uint64_t hashOf(uint64_t key)
{
    key += kHashStep;
    key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9u;
    key = (key ^ (key >> 27)) * 0x94d049bb133111ebu;
    return key ^ (key >> 31);
}

// The next of SplitMix64's own sequence.
inline uint64_t nextRandom(uint64_t& state)
{
    const uint64_t random = hashOf(state);
    state += kHashStep;
    return random;
}

inline uint64_t hashOf(uint64_t a, uint64_t b)
{
    return hashOf(hashOf(a) ^ b);
}

// In (0, 1), never an end.
inline double unitFromHash(uint64_t hash)
{
    return (static_cast<double>(hash >> 11) + 0.5) * 0x1p-53;
}

// Standard normal (Box and Muller, A Note on the Generation of Random Normal Deviates, 1958).
inline double gaussianFromHash(uint64_t hash)
{
    const double radius = std::sqrt(-2.0 * std::log(unitFromHash(hash)));
    return radius * std::cos(2.0 * std::numbers::pi * unitFromHash(hashOf(hash)));
}

} // namespace nacre
