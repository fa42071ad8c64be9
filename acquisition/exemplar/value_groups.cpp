#include "acquisition/exemplar/value_groups.h"

#include <algorithm>
#include <limits>

#include "engine/files/lanes.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr size_t kGroupsPerTask = 4;

// Bisection: the ends move to the nearest values on the middle's sides, so that few steps are left to the last one.
NACRE_VECTOR_CLONES
float weightedMedian(const float* values, const float* weights, size_t stride)
{
    const Lanes none = allLanes(std::numeric_limits<float>::infinity());
    Lanes least = none, most = none, total = allLanes(0);
    for (size_t i = 0; i < stride; i += kLanes) {
        const Lanes value = lanesAt(values + i), turned = value < none ? -value : none;
        least = value < least ? value : least;
        most = turned < most ? turned : most;
        total += lanesAt(weights + i);
    }
    const float half = sumOf(total) / 2;
    float low = leastOf(least), high = -leastOf(most); // the median is in [low, high]
    while (low < high) {
        const float between = low / 2 + high / 2, middle = between < high ? between : low; // neighbours' is rounded
        Lanes upTo = allLanes(0), below = none, above = none;
        for (size_t i = 0; i < stride; i += kLanes) {
            const Lanes value = lanesAt(values + i);
            const auto isUpTo = value <= middle;
            upTo += isUpTo ? lanesAt(weights + i) : allLanes(0);
            below = isUpTo && -value < below ? -value : below;
            above = !isUpTo && value < above ? value : above;
        }
        if (sumOf(upTo) >= half) {
            high = -leastOf(below);
        } else {
            low = leastOf(above);
        }
    }
    return low;
}

} // namespace

ValueGroups::ValueGroups(std::span<const int> groups, std::span<const float> weights, size_t groupCount)
    : counts_(groupCount, 0), slots_(groups.size())
{
    for (const int group : groups) {
        if (group >= 0) {
            ++counts_[group];
        }
    }
    size_t slots = 0;
    for (const size_t count : counts_) {
        firsts_.push_back(slots);
        slots += (count + kLanes - 1) / kLanes * kLanes;
    }
    weights_.assign(slots + 1, 0.0f);
    std::vector<size_t> next = firsts_;
    for (size_t i = 0; i < groups.size(); ++i) {
        slots_[i] = groups[i] >= 0 ? next[groups[i]]++ : slots;
        weights_[slots_[i]] = groups[i] >= 0 ? weights[i] : 0.0f;
    }
    firsts_.push_back(slots);
}

std::vector<float> ValueGroups::medians(std::span<const float> values, int threads) const
{
    std::vector<float> sorted(weights_.size(), std::numeric_limits<float>::infinity());
    for (size_t i = 0; i < values.size(); ++i) {
        sorted[slots_[i]] = values[i];
    }
    std::vector<float> result(groupCount(), 0.0f);
    parallelFor(result.size(), kGroupsPerTask, threads, [&](size_t first, size_t last) {
        for (size_t group = first; group < last; ++group) {
            const size_t slot = firsts_[group];
            if (counts_[group] > 0) {
                result[group] = weightedMedian(&sorted[slot], &weights_[slot], firsts_[group + 1] - slot);
            }
        }
    });
    return result;
}

} // namespace nacre
