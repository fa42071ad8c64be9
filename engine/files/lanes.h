#pragma once
#include <algorithm>
#ifdef __SSE__
#include <xmmintrin.h>
#else
#include <cmath>
#endif

// Functions on lanes are inlined where they are called, so that no caller passes them in registers of another width.
#pragma GCC diagnostic ignored "-Wpsabi"
#define NACRE_ON_LANES [[gnu::always_inline]] inline

namespace nacre {

// Eight floats side by side (GCC's vector extension), read from any float's address. Loops over them keep eight partial
// sums, so that their result does not depend on the machine's vector width.
constexpr int kLanes = 8;
typedef float Lanes __attribute__((vector_size(32), aligned(4), may_alias));
typedef int LaneCounts __attribute__((vector_size(32)));

NACRE_ON_LANES const Lanes& lanesAt(const float* first)
{
    return *reinterpret_cast<const Lanes*>(first);
}

NACRE_ON_LANES Lanes allLanes(float value)
{
    return Lanes{value, value, value, value, value, value, value, value};
}

NACRE_ON_LANES Lanes absolute(const Lanes& lanes)
{
    return lanes < 0 ? -lanes : lanes;
}

// By halves in registers: what is written to memory by halves and read as a whole is waited for.
NACRE_ON_LANES Lanes rootOf(const Lanes& lanes)
{
#ifdef __SSE__
    const __m128 low = _mm_sqrt_ps(__builtin_shufflevector(lanes, lanes, 0, 1, 2, 3)),
                 high = _mm_sqrt_ps(__builtin_shufflevector(lanes, lanes, 4, 5, 6, 7));
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
#else
    Lanes result;
    for (int k = 0; k < kLanes; ++k) {
        result[k] = std::sqrt(lanes[k]);
    }
    return result;
#endif
}

// Pairwise, so that the result does not depend on how it is compiled.
NACRE_ON_LANES float sumOf(const Lanes& lanes)
{
    const auto* l = reinterpret_cast<const float*>(&lanes);
    return ((l[0] + l[1]) + (l[2] + l[3])) + ((l[4] + l[5]) + (l[6] + l[7]));
}

NACRE_ON_LANES float leastOf(const Lanes& lanes)
{
    const auto* l = reinterpret_cast<const float*>(&lanes);
    return std::min(std::min(std::min(l[0], l[1]), std::min(l[2], l[3])),
                    std::min(std::min(l[4], l[5]), std::min(l[6], l[7])));
}

NACRE_ON_LANES int sumOf(const LaneCounts& counts)
{
    const auto* c = reinterpret_cast<const int*>(&counts);
    return ((c[0] + c[1]) + (c[2] + c[3])) + ((c[4] + c[5]) + (c[6] + c[7]));
}

} // namespace nacre

// A function compiled twice, for AVX2 and for any x86-64, chosen when the program starts. Neither fuses multiply-add,
// so both give the same bytes.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define NACRE_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define NACRE_VECTOR_CLONES
#endif
