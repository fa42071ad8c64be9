#include "evaluation/charts/chart.h"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

namespace nacre {
namespace {

struct Cost {
    double x, y;
};

// Of errors; 1 is added, as a logarithmic axis shows nothing at 0.
std::vector<char> paretoFront(const std::vector<Cost>& costs)
{
    Chart chart;
    for (const Cost& cost : costs) {
        chart.points.push_back({"", "", 1 + cost.x, 1 + cost.y});
    }
    return frontOf(chart);
}

// Small whole numbers, so that ties in one and in both are frequent.
std::vector<Cost> drawnCosts(uint32_t seed, size_t count)
{
    std::vector<Cost> costs;
    uint32_t state = seed * 2654435761u + 1;
    const auto next = [&] {
        state = state * 1664525u + 1013904223u;
        return static_cast<double>((state >> 24) % 12);
    };
    for (size_t i = 0; i < count; ++i) {
        const double x = next();
        costs.push_back({x, next()});
    }
    return costs;
}

TEST(ParetoFront, NothingOnItIsDominatedAndEverythingElseIsBySomethingOnIt)
{
    for (uint32_t seed = 0; seed < 50; ++seed) {
        const std::vector<Cost> costs = drawnCosts(seed, 1 + seed);
        const std::vector<char> front = paretoFront(costs);
        ASSERT_EQ(front.size(), costs.size());
        for (size_t i = 0; i < costs.size(); ++i) {
            bool dominated = false, byFront = false;
            for (size_t j = 0; j < costs.size(); ++j) {
                const bool better = costs[j].x <= costs[i].x && costs[j].y <= costs[i].y &&
                                    (costs[j].x != costs[i].x || costs[j].y != costs[i].y);
                dominated |= better;
                byFront |= better && front[j];
            }
            EXPECT_EQ(front[i] != 0, !dominated) << seed << " " << i;
            EXPECT_EQ(dominated, byFront) << seed << " " << i;
        }
    }
}

TEST(ParetoFront, EqualsStayTogetherAndTiesInOneAreDecidedByTheOther)
{
    const std::vector<Cost> costs = {{1, 3}, {1, 3}, {1, 4}, {2, 3}, {3, 1}, {2, 2}};
    EXPECT_EQ(paretoFront(costs), (std::vector<char>{1, 1, 0, 0, 1, 1}));
    EXPECT_TRUE(paretoFront({}).empty());
}

TEST(ParetoFront, WhatIsNoNumberNeitherWinsNorBeats)
{
    const double none = std::nan("");
    const std::vector<Cost> costs = {{none, 0}, {0, none}, {5, 5}};
    EXPECT_EQ(paretoFront(costs), (std::vector<char>{0, 0, 1}));
}

} // namespace
} // namespace nacre
