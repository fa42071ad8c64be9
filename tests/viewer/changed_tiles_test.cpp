// What a window draws again: held against the pixels of pictures that are painted from the same boxes.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "engine/view_state/changed_tiles.h"

namespace nacre::test {
namespace {

struct Painted {
    PixelBox box;
    uint64_t look;
};

constexpr glm::ivec2 kSize{150, 70}; // no multiple of a tile

std::vector<uint64_t> pixelsOf(const std::vector<Painted>& all)
{
    std::vector<uint64_t> pixels(static_cast<size_t>(kSize.x) * kSize.y, 0);
    for (const auto& [box, look] : all) {
        const PixelBox seen = overlap(box, {{0, 0}, kSize});
        for (int y = seen.low.y; y < seen.high.y; ++y) {
            for (int x = seen.low.x; x < seen.high.x; ++x) {
                pixels[static_cast<size_t>(y) * kSize.x + x] = look;
            }
        }
    }
    return pixels;
}

std::vector<PixelBox> changedBy(ChangedTiles& tiles, const std::vector<Painted>& all)
{
    tiles.begin(kSize);
    for (const auto& [box, look] : all) {
        tiles.add(box, look);
    }
    return tiles.changed();
}

int64_t areaOf(const std::vector<PixelBox>& boxes)
{
    int64_t area = 0;
    for (const PixelBox& box : boxes) {
        area += int64_t{box.high.x - box.low.x} * (box.high.y - box.low.y);
    }
    return area;
}

TEST(ChangedTiles, BoxesHoldAllThatDiffersAndDoNotOverlap)
{
    std::mt19937 random(7);
    const auto upTo = [&](int most) { return std::uniform_int_distribution(-20, most + 20)(random); };
    ChangedTiles tiles;
    std::vector<Painted> all;
    std::vector<uint64_t> before;
    for (int frame = 0; frame < 300; ++frame) {
        if (all.size() < 6) {
            const glm::ivec2 low(upTo(kSize.x), upTo(kSize.y));
            all.push_back({{low, low + glm::ivec2(upTo(60), upTo(40))}, random()});
        } else if (frame % 3 == 0) {
            std::swap(all[random() % all.size()], all[random() % all.size()]);
        } else {
            all.erase(all.begin() + static_cast<std::ptrdiff_t>(random() % all.size()));
        }
        const std::vector<PixelBox> boxes = changedBy(tiles, all);
        const std::vector<uint64_t> now = pixelsOf(all);
        std::vector<int> covered(now.size(), 0);
        for (const PixelBox& box : boxes) {
            for (int y = box.low.y; y < box.high.y; ++y) {
                for (int x = box.low.x; x < box.high.x; ++x) {
                    ++covered.at(static_cast<size_t>(y) * kSize.x + x);
                }
            }
        }
        for (size_t i = 0; i < now.size(); ++i) {
            EXPECT_LE(covered[i], 1);
            EXPECT_TRUE(covered[i] == 1 || (!before.empty() && now[i] == before[i])) << "frame " << frame;
        }
        before = now;
    }
}

TEST(ChangedTiles, WhatStaysIsNotDrawnAgain)
{
    ChangedTiles tiles;
    const std::vector<Painted> all = {{{{3, 3}, {40, 20}}, 1}, {{{100, 40}, {110, 50}}, 2}};
    EXPECT_EQ(areaOf(changedBy(tiles, all)), int64_t{kSize.x} * kSize.y) << "all of the first";
    EXPECT_TRUE(changedBy(tiles, all).empty());
    const auto other = changedBy(tiles, {all[0], {all[1].box, 3}});
    EXPECT_EQ(other, (std::vector{PixelBox{{96, 32}, {128, 64}}})) << "its tile";
    tiles.forget();
    EXPECT_EQ(areaOf(changedBy(tiles, all)), int64_t{kSize.x} * kSize.y) << "nothing is at hand any more";
    tiles.begin({kSize.x + 1, kSize.y});
    EXPECT_EQ(areaOf(tiles.changed()), int64_t{kSize.x + 1} * kSize.y) << "another size";
}

} // namespace
} // namespace nacre::test
