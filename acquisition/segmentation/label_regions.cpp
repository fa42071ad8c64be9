#include "acquisition/segmentation/label_regions.h"

#include <algorithm>
#include <array>

namespace nacre {

namespace {

// visit(index) for the pixels of the object in the square around `pixel`, itself included.
template <class Visit> void forEachAround(const LabelGrid& grid, size_t pixel, int radius, Visit&& visit)
{
    const int x = static_cast<int>(pixel % grid.width), y = static_cast<int>(pixel / grid.width);
    for (int v = std::max(0, y - radius); v <= std::min(grid.height - 1, y + radius); ++v) {
        for (int u = std::max(0, x - radius); u <= std::min(grid.width - 1, x + radius); ++u) {
            const size_t other = static_cast<size_t>(v) * grid.width + u;
            if (grid.mask[other]) {
                visit(other);
            }
        }
    }
}

// The connected part of one label that holds `seed`, its pixels marked as seen.
std::vector<size_t> partOf(const LabelGrid& grid, const std::vector<uint8_t>& labels, size_t seed,
                           std::vector<uint8_t>& seen)
{
    std::vector<size_t> part{seed};
    seen[seed] = 1;
    for (size_t next = 0; next < part.size(); ++next) {
        const size_t pixel = part[next];
        const auto take = [&](size_t other) {
            if (grid.mask[other] && !seen[other] && labels[other] == labels[seed]) {
                seen[other] = 1;
                part.push_back(other);
            }
        };
        const size_t x = pixel % grid.width, y = pixel / grid.width, width = grid.width;
        if (x > 0) {
            take(pixel - 1);
        }
        if (x + 1 < width) {
            take(pixel + 1);
        }
        if (y > 0) {
            take(pixel - width);
        }
        if (y + 1 < static_cast<size_t>(grid.height)) {
            take(pixel + width);
        }
    }
    return part;
}

} // namespace

void fillUnlabelled(const LabelGrid& grid, std::vector<uint8_t>& labels)
{
    std::vector<size_t> queue;
    for (size_t i = 0; i < labels.size(); ++i) {
        if (grid.mask[i] && labels[i] != kUnlabelled) {
            queue.push_back(i);
        }
    }
    for (size_t next = 0; next < queue.size(); ++next) {
        const uint8_t label = labels[queue[next]];
        forEachAround(grid, queue[next], 1, [&](size_t other) {
            if (labels[other] == kUnlabelled) {
                labels[other] = label;
                queue.push_back(other);
            }
        });
    }
}

void takeMajority(const LabelGrid& grid, int radius, std::vector<uint8_t>& labels)
{
    const std::vector<uint8_t> before = labels;
    for (size_t i = 0; i < labels.size(); ++i) {
        if (!grid.mask[i] || before[i] == kUnlabelled) {
            continue;
        }
        std::array<int, 256> votes{};
        forEachAround(grid, i, radius, [&](size_t other) { ++votes[before[other]]; });
        votes[kUnlabelled] = 0;
        const auto most = std::max_element(votes.begin(), votes.end());
        if (*most > votes[before[i]]) {
            labels[i] = static_cast<uint8_t>(most - votes.begin());
        }
    }
}

void dissolveSmallParts(const LabelGrid& grid, size_t fewest, std::vector<uint8_t>& labels)
{
    const std::vector<uint8_t> before = labels;
    std::vector<uint8_t> seen(labels.size(), 0);
    for (size_t i = 0; i < labels.size(); ++i) {
        if (!grid.mask[i] || seen[i] || before[i] == kUnlabelled) {
            continue;
        }
        const std::vector<size_t> part = partOf(grid, before, i, seen);
        for (size_t p = 0; p < part.size() && part.size() < fewest; ++p) {
            labels[part[p]] = kUnlabelled;
        }
    }
    fillUnlabelled(grid, labels);
    for (size_t i = 0; i < labels.size(); ++i) {
        labels[i] = labels[i] == kUnlabelled ? before[i] : labels[i];
    }
}

std::vector<uint8_t> innerPixels(const LabelGrid& grid, int radius, const std::vector<uint8_t>& labels)
{
    std::vector<uint8_t> inner(labels.size(), 0);
    for (size_t i = 0; i < labels.size(); ++i) {
        if (grid.mask[i]) {
            inner[i] = 1;
            forEachAround(grid, i, radius, [&](size_t other) { inner[i] &= labels[other] == labels[i]; });
        }
    }
    return inner;
}

} // namespace nacre
