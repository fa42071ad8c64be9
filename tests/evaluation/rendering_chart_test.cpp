#include "evaluation/rendering/chart_rendering.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "evaluation/charts/chart.h"
#include "evaluation/rendering/bench_surfaces.h"

namespace nacre {
namespace {

Chart twoQuestions()
{
    Chart chart{"t", "ms", "dB", false, {}, true};
    chart.points = {{"1 light", "direct", 2, 60},
                    {"1 light", "ball", 1, 50, true},
                    {"1 light", "worse", 3, 40},
                    {"8 lights", "direct", 16, 60},
                    {"8 lights", "ball", 1.1, 49, true}};
    return chart;
}

TEST(ChartPerSeries, EverySeriesHasItsOwnFrontAndDefault)
{
    Chart chart = twoQuestions();
    EXPECT_EQ(frontOf(chart), (std::vector<char>{1, 1, 0, 1, 1}));
    chart.isFrontPerSeries = false;
    EXPECT_EQ(frontOf(chart), (std::vector<char>{1, 1, 0, 0, 0})) << "8 lights lose against 1 where they compete";
}

TEST(ChartPerSeries, DefaultsAreBeatenWithinTheirSeriesAlone)
{
    Chart chart = twoQuestions();
    EXPECT_TRUE(clearlyBetter(chart).empty()) << "1 light beats 8, but that is no setting";
    const std::string words = describeDefault(chart);
    EXPECT_NE(words.find("(1 light, ball)"), std::string::npos) << words;
    EXPECT_NE(words.find("(8 lights, ball)"), std::string::npos) << words;
    chart.points.push_back({"8 lights", "better", 0.9, 51});
    EXPECT_EQ(clearlyBetter(chart), (std::vector<size_t>{5}));
}

// A picture of 5 x 4 with an object of 2 x 1 at (3, 2).
Surface smallSurface()
{
    Surface surface;
    surface.normals = NormalMap(5, 4);
    surface.labels.assign(20, Surface::kNoMaterial);
    surface.albedo = Image(5, 4, 3, 1);
    for (const int x : {3, 4}) {
        const size_t i = surface.normals.index(x, 2);
        surface.normals.normals[i] = {0, 0, 1};
        surface.normals.confidence[i] = 1;
        surface.labels[i] = static_cast<uint8_t>(x - 3);
        surface.albedo.setRgb(x, 2, glm::vec3(x));
    }
    return surface;
}

TEST(RenderingChart, TilesRepeatTheObjectAloneAndFillThePicture)
{
    const Surface tiled = tiledSurface(smallSurface(), 7, 3);
    for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 7; ++x) {
            const size_t i = tiled.normals.index(x, y);
            EXPECT_EQ(tiled.labels[i], x % 2);
            EXPECT_EQ(tiled.normals.confidence[i], 1);
            EXPECT_EQ(tiled.albedo.rgb(x, y).y, 3 + x % 2);
        }
    }
    EXPECT_EQ(tiled.labels.size(), 21u);
}

TEST(RenderingChart, LightsSumToOneFaceTheSurfaceAndAllMove)
{
    for (const int count : {1, 8, 64}) {
        const std::vector<Light> still = benchLights(count, 0), moved = benchLights(count, 1);
        ASSERT_EQ(still.size(), static_cast<size_t>(count));
        float sum = 0;
        for (size_t i = 0; i < still.size(); ++i) {
            sum += still[i].irradiance.x;
            EXPECT_GT(still[i].direction.z, 0.7f) << "cos 42 degrees is 0.74";
            EXPECT_NE(still[i].direction, moved[i].direction);
        }
        EXPECT_NEAR(sum, 1, 1e-5f) << "of up to 64 floats";
    }
}

} // namespace
} // namespace nacre
