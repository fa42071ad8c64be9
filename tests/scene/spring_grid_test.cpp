#include <cmath>

#include <gtest/gtest.h>

#include "engine/files/hash_random.h"
#include "engine/surface/spring_grid.h"

namespace nacre {
namespace {

// A row of pixels in two pieces, (0 1 2) and (4 5), joined by one spring: everything pulls by known steps, so that all
// springs rest and the heights are exact.
TEST(SpringSolver, LinksJoinPieces)
{
    GridSprings grid(6, 1);
    grid.right = {1, 2, 0, 0, 3, 0};
    const std::vector<double> truth{0, 1, 3, 0, 10, 8};
    const std::vector<SpringLink> links{{1, 4, 0.5}};
    std::vector<double> pull(6, 0.0), height(6, 0.0);
    const auto stretch = [&](size_t a, size_t b, double weight) {
        pull[b] += weight * (truth[b] - truth[a]);
        pull[a] -= weight * (truth[b] - truth[a]);
    };
    stretch(0, 1, 1);
    stretch(1, 2, 2);
    stretch(4, 5, 3);
    stretch(1, 4, 0.5);
    SpringSolver solver(grid, links, 1);
    const SpringSolver::Result result = solver.solve(pull, height, 1e-10, 100);
    EXPECT_LE(result.residual, 1e-10);
    for (const size_t i : {1u, 2u, 4u, 5u}) {
        EXPECT_NEAR(height[i] - height[0], truth[i] - truth[0], 1e-6) << i;
    }
}

// Springs that contradict each other share the error by their weights.
TEST(SpringSolver, WeightsShareAContradiction)
{
    GridSprings grid(2, 1);
    grid.right = {1, 0};
    const std::vector<SpringLink> links{{0, 1, 3}};
    const std::vector<double> pull{-1.0 * 2 - 3.0 * 6, 1.0 * 2 + 3.0 * 6}; // steps of 2 and 6
    std::vector<double> height(2, 0.0);
    SpringSolver(grid, links, 1).solve(pull, height, 1e-10, 100);
    EXPECT_NEAR(height[1] - height[0], 5, 1e-6);
}

// A picture of 64 flat tiles at heights of their own, which links alone hold together: each joins pixels of two tiles
// that touch at a side. Coarse grids that know the links move whole tiles: 6 rounds, where others take 22.
TEST(SpringSolver, LinksMoveWholeRegionsInFewRounds)
{
    constexpr uint32_t kTile = 16, kTiles = 8, kSide = kTile * kTiles;
    GridSprings grid(kSide, kSide);
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
        grid.right[i] = i % kTile + 1 < kTile ? 1 : 0;
        grid.down[i] = i / kSide % kTile + 1 < kTile ? 1 : 0;
    }
    uint64_t random = 0;
    const auto below = [&](uint32_t count) { return static_cast<uint32_t>(nextRandom(random) % count); };
    const auto pixelOf = [&](uint32_t column, uint32_t row) {
        return (row * kTile + below(kTile)) * kSide + column * kTile + below(kTile);
    };
    std::vector<SpringLink> links;
    std::vector<double> pull(grid.size(), 0.0), height(grid.size(), 0.0);
    const auto truth = [](uint32_t pixel) { return (pixel % kSide / kTile * 5 + pixel / kSide / kTile * 3) % 7 * 1.0; };
    for (int i = 0; i < 4000; ++i) {
        const uint32_t column = below(kTiles - 1), row = below(kTiles - 1);
        const uint32_t from = pixelOf(column, row),
                       to = i % 2 == 0 ? pixelOf(column + 1, row) : pixelOf(column, row + 1);
        links.push_back({from, to, 0.2});
        pull[from] -= 0.2 * (truth(to) - truth(from));
        pull[to] += 0.2 * (truth(to) - truth(from));
    }
    const SpringSolver::Result result = SpringSolver(grid, links, 1).solve(pull, height, 1e-4, 100);
    EXPECT_LE(result.iterations, 10);
    const uint32_t first = kTile / 2 * kSide + kTile / 2, last = first + (kTiles - 2) * kTile * (kSide + 1);
    EXPECT_NEAR(height[last] - height[first], truth(last) - truth(first), 0.05);
}

// Links between the same pixels are one, whichever comes first; a link from a pixel to itself is none.
TEST(LinkRows, EqualLinksAreOne)
{
    const LinkRows rows(4, {{0, 3, 1}, {3, 0, 2}, {2, 2, 9}, {1, 3, 4}});
    std::vector<double> sums(4, 0.0);
    rows.addPull(2, {1, 10, 100, 1000}, sums);
    EXPECT_EQ(rows.rows().size(), 4u);
    EXPECT_EQ(sums, (std::vector<double>{6000, 8000, 0, 2 * (3 + 40)}));
}

} // namespace
} // namespace nacre
