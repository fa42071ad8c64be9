#pragma once

namespace nacre {

// Eight floats side by side (GCC's vector extension), read from any float's address. Loops over them keep eight partial
// sums, so that their result does not depend on the machine's vector width.
constexpr int kLanes = 8;
typedef float Lanes __attribute__((vector_size(32), aligned(4), may_alias));

inline const Lanes& lanesAt(const float* first)
{
    return *reinterpret_cast<const Lanes*>(first);
}

// Pairwise, so that the result does not depend on how it is compiled.
inline float sumOf(const Lanes& lanes)
{
    const auto* l = reinterpret_cast<const float*>(&lanes);
    return ((l[0] + l[1]) + (l[2] + l[3])) + ((l[4] + l[5]) + (l[6] + l[7]));
}

} // namespace nacre

// A function compiled twice, for AVX2 and for any x86-64, chosen when the program starts. Neither fuses multiply-add,
// so both give the same bytes.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define NACRE_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define NACRE_VECTOR_CLONES
#endif
