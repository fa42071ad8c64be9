#include <cmath>

#include <gtest/gtest.h>

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

} // namespace
} // namespace nacre
