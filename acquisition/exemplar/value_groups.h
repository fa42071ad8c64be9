#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace nacre {

// Weighted values in groups, put side by side once, for medians of values that change.
class ValueGroups {
public:
    // `groups` and `weights` have one entry a value; group -1: it takes no part.
    ValueGroups(std::span<const int> groups, std::span<const float> weights, size_t groupCount);

    size_t groupCount() const { return counts_.size(); }
    size_t count(size_t group) const { return counts_[group]; }
    // Of each group: the least value that no less than half of the weight is at or below; 0 where it is empty.
    // `values` are finite, in the order of the groups given.
    std::vector<float> medians(std::span<const float> values, int threads) const;

private:
    std::vector<size_t> counts_, firsts_; // of each group; a group begins at a whole number of lanes
    std::vector<size_t> slots_;           // for each value, one beyond the last where it takes no part
    std::vector<float> weights_;          // by slot, 0 between groups
};

} // namespace nacre
