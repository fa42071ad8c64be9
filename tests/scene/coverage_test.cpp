// The share of a scene that is uncertain.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/scene/coverage.h"
#include "engine/surface/surface.h"

namespace nacre {
namespace {

// Half-difference up to 20 degrees of thetaD: lights up to 40 from the view.
BrdfTable frontTable(float confidence)
{
    BrdfTable table({8, 4, 4}, {kHalfDifference, 20 * kPi / 180});
    table.values.assign(table.values.size(), glm::vec3(1));
    table.confidence.assign(table.confidence.size(), confidence);
    return table;
}

glm::vec3 tilted(float degrees)
{
    return {std::sin(degrees * kPi / 180), 0, std::cos(degrees * kPi / 180)};
}

// Normals tilted by -80 to 79 degrees, a pixel a degree, of one material.
Scene arcOf(const BrdfTable& table)
{
    NormalMap normals(160, 1);
    for (int i = 0; i < normals.width; ++i) {
        normals.normals[i] = tilted(static_cast<float>(i - 80));
        normals.confidence[i] = 1;
    }
    Scene scene;
    scene.surface = transferredSurface(normals, {"arc", table, {}});
    return scene;
}

TEST(Coverage, LightsBeyondTheTableAreWeighedByWhatTheyAdd)
{
    Scene scene = arcOf(frontTable(1));
    scene.lights = {{tilted(0), glm::vec3(1)}};
    EXPECT_EQ(uncertainShare(scene), 0);
    scene.lights = {{tilted(61), glm::vec3(1)}};
    EXPECT_EQ(uncertainShare(scene), 1);
    scene.lights.push_back({tilted(0), glm::vec3(1)});
    // Twice the bound of the one, nothing of the other: beyond 30.5 degrees the one is stronger.
    EXPECT_NEAR(uncertainShare(scene), 49 / 160.0, 1e-9);
    scene.lights[0].irradiance = glm::vec3(0.01f);
    EXPECT_EQ(uncertainShare(scene), 0) << "a faint light makes no picture uncertain";
}

// The outermost texels of thetaH, from 90 (36 / 49) = 66 to 90 degrees, are as `change` makes them.
template <class Change> double shareOfOuterTexels(BrdfTable table, const Change& change)
{
    for (int k = 0; k < table.size.z; ++k) {
        for (int j = 0; j < table.size.y; ++j) {
            change(table, table.index(7, j, k));
        }
    }
    Scene scene = arcOf(table);
    scene.lights = {{tilted(0), glm::vec3(1)}};
    return uncertainShare(scene);
}

TEST(Coverage, ThinTexelsCountWhereNoErrorIsTold)
{
    // Coverage falls through 0.5 in the middle of the last cell: thetaH of 90 (13 / 14)^2 = 77.6 degrees.
    EXPECT_NEAR(shareOfOuterTexels(frontTable(1), [](BrdfTable& t, size_t i) { t.confidence[i] = 0; }), 5 / 160.0,
                1e-9);
}

TEST(Coverage, ToldErrorsCountAndAreInterpolatedLikeTheBrdf)
{
    BrdfTable told = frontTable(0);
    told.error.assign(told.values.size(), 0.1f);
    const auto shareAt = [&](float error) {
        return shareOfOuterTexels(told, [&](BrdfTable& t, size_t i) { t.error[i] = error; });
    };
    EXPECT_EQ(shareAt(0.19f), 0) << "no sample is near, and yet f is known";
    EXPECT_NEAR(shareAt(0.3f), 5 / 160.0, 1e-9) << "0.2 is half way";
    EXPECT_NEAR(shareAt(0.5f), 17 / 160.0, 1e-9) << "a quarter: thetaH of 90 (25 / 28)^2 = 71.7 degrees";
}

TEST(Coverage, WhatSaysNothingIsCertain)
{
    Scene scene = arcOf(frontTable(0));
    scene.lights = {{tilted(60), glm::vec3(1)}};
    EXPECT_EQ(uncertainShare(scene), 0);
    scene = arcOf(frontTable(1));
    EXPECT_EQ(uncertainShare(scene), 0) << "no lights";
    scene.lights = {{tilted(60), glm::vec3(0)}};
    EXPECT_EQ(uncertainShare(scene), 0) << "a black light reaches nothing";
}

TEST(Coverage, ASampleIsNearAndTheSameForAnyThreads)
{
    Scene scene = arcOf(frontTable(1));
    NormalMap wide(160, 40);
    for (int i = 0; i < 6400; ++i) {
        wide.normals[i] = scene.surface.normals.normals[i % 160];
        wide.confidence[i] = 1;
    }
    scene.surface = transferredSurface(wide, scene.surface.materials[0]);
    for (const float degrees : {0.0f, 61.0f}) {
        scene.lights.push_back({tilted(degrees), glm::vec3(1)});
    }
    const auto share = [&](size_t pairs, int threads) {
        return uncertainShare(scene.surface, scene.lights, scene.view, pairs, threads);
    };
    // Of 6400 pixels 800: one share is the other within three standard errors of a proportion, 0.049.
    EXPECT_NEAR(share(1600, 1), 49 / 160.0, 0.049);
    EXPECT_EQ(share(1600, 1), share(1600, 3));
    EXPECT_NEAR(share(12800, 3), 49 / 160.0, 1e-9);
}

TEST(Coverage, SharesAreSaidInTermsOfTheBound)
{
    EXPECT_EQ(describeUncertainShare(0), "");
    EXPECT_EQ(describeUncertainShare(1e-5), "below 0.1 % of this picture is uncertain by more than 20 %");
    EXPECT_EQ(describeUncertainShare(0.0612), "6.1 % of this picture is uncertain by more than 20 %");
}

TEST(SampledPixels, AreAllOrEvenlySpread)
{
    Scene scene = arcOf(frontTable(1));
    scene.surface.labels[3] = Surface::kNoMaterial;
    scene.surface.normals.confidence[5] = 0;
    const Surface all = sampledPixels(scene.surface, 1000), some = sampledPixels(scene.surface, 10);
    const auto count = [](const Surface& s) {
        return std::count_if(s.normals.confidence.begin(), s.normals.confidence.end(), [](float c) { return c > 0; });
    };
    EXPECT_EQ(count(all), 158);
    EXPECT_EQ(all.normals.normals[3], scene.surface.normals.normals[4]);
    EXPECT_EQ(count(some), 10);
    EXPECT_GT(some.normals.normals[9].x, 0.8f) << "the last of them lies near the end";
    EXPECT_EQ(sampledPixels(Surface{}, 10).normals.width, 1);
}

} // namespace
} // namespace nacre
