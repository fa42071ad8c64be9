#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/brdf/brdf_samples.h"

namespace nacre {
namespace {

constexpr float kDiffuse = 0.3f, kPeak = 6.0f, kFactor = 2.0f, kCosine = 0.8f;

// A peak about the mirror direction on a diffuse base.
BrdfTable peakedTable()
{
    BrdfTable table({65, 2, 2}, {kHalfDifference, 0.8f});
    for (int i = 0; i < table.size.x; ++i) {
        for (int row = 0; row < 4; ++row) {
            table.values[table.index(i, row % 2, row / 2)] = glm::vec3(i < 16 ? kPeak : kDiffuse);
        }
    }
    return table;
}

// One pixel that faces the camera: ten lights far from the mirror direction, and the last one at the camera.
struct OnePixel {
    Observations block;
    NormalMap normals{1, 1};
    Image albedo{1, 1, 3};
    std::vector<Light> lights;

    OnePixel()
    {
        for (int i = 0; i < 10; ++i) {
            const float azimuth = 0.6f * static_cast<float>(i), sine = std::sqrt(1 - kCosine * kCosine);
            lights.push_back({{sine * std::cos(azimuth), sine * std::sin(azimuth), kCosine}, glm::vec3(1)});
        }
        lights.push_back({{0, 0, 1}, glm::vec3(1)});
        block.lightCount = lights.size();
        block.pixels = {0};
        block.radiance.assign(lights.size(), glm::vec3(kFactor * kDiffuse * kCosine));
        block.radiance.back() = glm::vec3(kFactor * kPeak);
        block.saturated.assign(lights.size(), 0);
        block.width = 1;
        normals.normals[0] = {0, 0, 1};
        normals.confidence[0] = 1;
        albedo.setRgb(0, 0, glm::vec3(kFactor));
    }
    BrdfSamples samples() const
    {
        BrdfSamples samples;
        samples.domain = {kHalfDifference, 0.8f};
        gatherJudgedSamples(block, normals, albedo, LocalLights(lights), peakedTable(), 1, {}, samples);
        return samples;
    }
};

TEST(JudgedSamples, WhatTheTableExplainsCountsByItsCosineAndFactor)
{
    const BrdfSamples samples = OnePixel().samples();
    ASSERT_EQ(samples.size(), 11u);
    for (size_t i = 0; i < samples.size(); ++i) {
        EXPECT_NEAR(samples.values[i].x, i < 10 ? kDiffuse : kPeak, 1e-4f);
        EXPECT_NEAR(samples.weights[i], kFactor * (i < 10 ? kCosine : 1.0f), 1e-3f); // a miss of the rounding's size
    }
}

TEST(JudgedSamples, AShadowCountsLittle)
{
    OnePixel pixel;
    pixel.block.radiance[3] = glm::vec3(0);
    const BrdfSamples samples = pixel.samples();
    ASSERT_EQ(samples.size(), 11u);
    EXPECT_EQ(samples.values[3].x, 0);
    // 1 / (1 + (2 / 0.225)^2) of the square weight.
    EXPECT_LT(std::pow(samples.weights[3] / samples.weights[2], 2.0f), 0.015f);
    EXPECT_GT(samples.weights[3], 0);
}

TEST(JudgedSamples, AHighlightIsJudgedAgainstItself)
{
    OnePixel pixel;
    pixel.block.radiance.back() *= 1.1f; // off by five times the pixel's bright level
    const BrdfSamples samples = pixel.samples();
    ASSERT_EQ(samples.size(), 11u);
    // 1 / (1 + (2 * 0.1 / 0.225)^2) of the square weight.
    EXPECT_NEAR(std::pow(samples.weights.back() / kFactor, 2.0f), 0.56f, 0.02f);
}

TEST(JudgedSamples, ClippedAndGrazingLightGivesNone)
{
    OnePixel pixel;
    pixel.block.saturated[0] = 1;
    pixel.lights[1].direction = glm::normalize(glm::vec3(1, 0, 0.05f));
    EXPECT_EQ(pixel.samples().size(), 9u);
    pixel.normals.confidence[0] = 0;
    EXPECT_EQ(pixel.samples().size(), 0u);
}

} // namespace
} // namespace nacre
