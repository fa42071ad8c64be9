#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "acquisition/exemplar/value_groups.h"
#include "engine/files/hash_random.h"

namespace nacre {
namespace {

// The least value that no less than half of the weight is at or below.
float sortedMedian(std::vector<std::pair<float, float>> pairs)
{
    std::sort(pairs.begin(), pairs.end());
    double total = 0, upTo = 0;
    for (const auto& [value, weight] : pairs) {
        total += weight;
    }
    for (const auto& [value, weight] : pairs) {
        upTo += weight;
        if (upTo >= total / 2) {
            return value;
        }
    }
    return 0;
}

TEST(ValueGroups, MediansAreThoseOfTheSortedValues)
{
    constexpr size_t kGroups = 30;
    std::vector<int> groups;
    std::vector<float> weights, values;
    std::vector<std::vector<std::pair<float, float>>> pairs(kGroups);
    for (size_t i = 0; i < 3000; ++i) {
        const auto random = [&](uint64_t which) { return static_cast<float>(unitFromHash(hashOf(i, which))); };
        // Few in the first groups, none in the last; some values shared, some next to each other as floats.
        groups.push_back(static_cast<int>((kGroups - 1) * random(0) * random(0)) - (i % 7 == 0 ? 1 : 0));
        weights.push_back(static_cast<float>(1 + i % 3));
        values.push_back(i % 5 == 0   ? std::round(4 * random(1))
                         : i % 5 == 1 ? std::nextafter(2.0f, 3.0f)
                                      : random(2) - 9);
        if (groups.back() >= 0) {
            pairs[groups.back()].push_back({values.back(), weights.back()});
        }
    }
    const ValueGroups all(groups, weights, kGroups);
    const std::vector<float> medians = all.medians(values, 2);
    ASSERT_EQ(medians.size(), kGroups);
    for (size_t group = 0; group < kGroups; ++group) {
        EXPECT_EQ(all.count(group), pairs[group].size());
        EXPECT_EQ(medians[group], sortedMedian(pairs[group])) << "group " << group;
    }
}

} // namespace
} // namespace nacre
