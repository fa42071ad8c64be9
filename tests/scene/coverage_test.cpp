// The share of a scene that asks for what was not measured.
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

TEST(Coverage, LightsBeyondTheTableCountByTheirCosine)
{
    Scene scene = arcOf(frontTable(1));
    scene.lights = {{tilted(0), glm::vec3(1)}};
    EXPECT_EQ(unmeasuredShare(scene).pixels, 0);
    scene.lights = {{tilted(60), glm::vec3(1)}};
    EXPECT_EQ(unmeasuredShare(scene).pixels, 1);
    EXPECT_EQ(unmeasuredShare(scene).light, 1);
    scene.lights.push_back({tilted(0), glm::vec3(1)});
    const UnmeasuredShare share = unmeasuredShare(scene);
    // The light at 60 degrees reaches -29 to 79, with sums of cosines 1 + sin(80 deg - 60 deg) and 2 sin(80 deg).
    EXPECT_NEAR(share.pixels, 109 / 160.0, 1e-9);
    EXPECT_NEAR(share.light,
                (1 + std::sin(20 * kPi / 180)) / (1 + std::sin(20 * kPi / 180) + 2 * std::sin(80 * kPi / 180)), 0.005);
}

TEST(Coverage, ThinTexelsCount)
{
    BrdfTable table = frontTable(1);
    for (int k = 0; k < table.size.z; ++k) {
        for (int j = 0; j < table.size.y; ++j) {
            table.confidence[table.index(7, j, k)] = 0; // thetaH from 90 (36 / 49) = 66 to 90 degrees
        }
    }
    Scene scene = arcOf(table);
    scene.lights = {{tilted(0), glm::vec3(1)}};
    // Coverage falls through 0.5 in the middle of the last cell: thetaH of 90 (13 / 14)^2 = 77.6 degrees.
    EXPECT_NEAR(unmeasuredShare(scene).pixels, 5 / 160.0, 1e-9);
}

TEST(Coverage, WhatSaysNothingAsksForNothing)
{
    Scene scene = arcOf(frontTable(0));
    scene.lights = {{tilted(60), glm::vec3(1)}};
    EXPECT_EQ(unmeasuredShare(scene).pixels, 0);
    scene = arcOf(frontTable(1));
    EXPECT_EQ(unmeasuredShare(scene).pixels, 0) << "no lights";
    scene.lights = {{tilted(60), glm::vec3(0)}};
    EXPECT_EQ(unmeasuredShare(scene).pixels, 0) << "a black light reaches nothing";
}

TEST(Coverage, ASampleIsNearAndTheSameForAnyThreads)
{
    Scene scene = arcOf(frontTable(1));
    std::vector<Light> lights;
    for (int i = 0; i < 5000; ++i) {
        lights.push_back({tilted(static_cast<float>(i % 100) - 50), glm::vec3(1)});
    }
    NormalMap wide(160, 40);
    for (int i = 0; i < 6400; ++i) {
        wide.normals[i] = scene.surface.normals.normals[i % 160];
        wide.confidence[i] = 1;
    }
    scene.surface = transferredSurface(wide, scene.surface.materials[0]);
    scene.lights = lights;
    const UnmeasuredShare sampled = unmeasuredShare(scene, 1);
    scene.lights.resize(100);
    // Of 6400 pixels 800: one share is the other within three standard errors of a proportion, 0.053.
    EXPECT_NEAR(sampled.light, unmeasuredShare(scene).light, 0.053);
    scene.lights = lights;
    EXPECT_EQ(unmeasuredShare(scene, 3).light, sampled.light);
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
