// Integration: a height that is known comes back from its normals.
#include <cmath>
#include <functional>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/surface/height_from_normals.h"

namespace nacre::test {
namespace {

using HeightFunction = std::function<double(double, double)>; // x right, y down, pixels

// Exact normals by derivatives over a ten-thousandth of a pixel.
NormalMap normalsOf(const HeightFunction& height, int width, int rows)
{
    constexpr double kStep = 1e-4;
    NormalMap map(width, rows);
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < width; ++x) {
            const double right = (height(x + kStep, y) - height(x - kStep, y)) / (2 * kStep);
            const double down = (height(x, y + kStep) - height(x, y - kStep)) / (2 * kStep);
            map.normals[map.index(x, y)] = glm::vec3(glm::normalize(glm::dvec3(-right, down, 1)));
            map.confidence[map.index(x, y)] = 1;
        }
    }
    return map;
}

double waves(double x, double y)
{
    return 8 * std::sin(x / 11) * std::cos(y / 17) + 0.1 * x - 0.02 * y + 3 * std::sin((x + y) / 7);
}

// Largest difference over the pixels of `chosen`, once each side's mean over them is taken away.
double largestError(const Image& height, const HeightFunction& truth, const std::function<bool(int, int)>& chosen)
{
    double offset = 0, count = 0, worst = 0;
    for (int pass = 0; pass < 2; ++pass) {
        for (int y = 0; y < height.height; ++y) {
            for (int x = 0; x < height.width; ++x) {
                if (chosen(x, y)) {
                    const double difference = height.at(x, y) - truth(x, y);
                    pass == 0 ? offset += difference, ++count : worst = std::max(worst, std::abs(difference - offset));
                }
            }
        }
        offset = pass == 0 ? offset / count : offset;
    }
    return worst;
}

bool everywhere(int, int)
{
    return true;
}

// The trapezoidal rule errs by a twelfth of the third derivative a step: 8 / 11^3 + 3 / 7^3, /12 = 0.001 pixels a step,
// in turns up and down.
TEST(HeightFromNormals, RecoversASmoothHeight)
{
    const IntegratedHeight result = heightFromNormals(normalsOf(waves, 301, 203));
    EXPECT_LT(largestError(result.height, waves, everywhere), 0.05) << "pixels, of a height of 50";
    EXPECT_EQ(result.pieces, 1u);
    EXPECT_LT(result.iterations, 60);
}

TEST(HeightFromNormals, TwoIslandsAreFoundEachForItself)
{
    NormalMap map = normalsOf(waves, 160, 90);
    const auto left = [](int x, int y) { return std::hypot(x - 40, y - 45) < 35; };
    const auto right = [](int x, int y) { return std::hypot(x - 118, y - 45) < 35; };
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            if (!left(x, y) && !right(x, y)) {
                map.normals[map.index(x, y)] = glm::vec3(0);
                map.confidence[map.index(x, y)] = 0;
            }
        }
    }
    const IntegratedHeight result = heightFromNormals(map);
    EXPECT_EQ(result.pieces, 2u);
    EXPECT_LT(largestError(result.height, waves, left), 0.05);
    EXPECT_LT(largestError(result.height, waves, right), 0.05);
    EXPECT_EQ(result.height.at(80, 5), 0) << "beside the islands";
}

// What has no confidence may hold anything, and what has little has little say.
TEST(HeightFromNormals, NothingIsTakenFromWhereThereIsNoConfidence)
{
    NormalMap map = normalsOf(waves, 120, 120);
    const auto hole = [](int x, int y) { return x > 50 && x < 70 && y > 30 && y < 80; };
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            if (hole(x, y)) {
                map.normals[map.index(x, y)] = glm::vec3(std::numeric_limits<float>::quiet_NaN());
                map.confidence[map.index(x, y)] = 0;
            }
        }
    }
    const auto outside = [&](int x, int y) { return !hole(x, y); };
    EXPECT_LT(largestError(heightFromNormals(map).height, waves, outside), 0.05);

    for (size_t i = 0; i < map.normals.size(); ++i) {
        if (map.confidence[i] == 0) {
            map.normals[i] = glm::normalize(glm::vec3(1, 1, 1));
            map.confidence[i] = 1e-6f;
        }
    }
    EXPECT_LT(largestError(heightFromNormals(map).height, waves, outside), 0.06);
}

TEST(HeightFromNormals, DoesNotDependOnThreads)
{
    const NormalMap map = normalsOf(waves, 300, 260);
    EXPECT_EQ(heightFromNormals(map, {.threads = 1}).height.values,
              heightFromNormals(map, {.threads = 3}).height.values);
}

TEST(HeightFromNormals, OddShapesEnd)
{
    EXPECT_EQ(heightFromNormals(NormalMap(7, 5)).pieces, 0u);
    NormalMap one(3, 3);
    one.normals[4] = {0, 0, 1};
    one.confidence[4] = 1;
    const IntegratedHeight result = heightFromNormals(one);
    EXPECT_EQ(result.pieces, 1u);
    EXPECT_EQ(result.height.values[4], 0);
    EXPECT_LT(largestError(heightFromNormals(normalsOf(waves, 200, 1)).height, waves, everywhere), 0.05);
}

} // namespace
} // namespace nacre::test
