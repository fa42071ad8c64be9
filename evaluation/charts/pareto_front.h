#pragma once
#include <span>
#include <vector>

namespace nacre {

// Two things of which less is better; what is to be large goes in negated.
struct Cost {
    double x = 0;
    double y = 0;
};

// Whether `a` is at least as good as `b` in both, and better in one. Equal costs do not dominate each other; nothing
// dominates by a number that is none.
bool dominates(const Cost& a, const Cost& b);

// 1 for each of the costs that no other dominates, 0 for those that one does and for those with a NaN.
std::vector<char> paretoFront(std::span<const Cost> costs);

} // namespace nacre
