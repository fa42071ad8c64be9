#include "acquisition/brdf/slope_trend.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "acquisition/chain/material_albedo.h"
#include "engine/files/hash_random.h"

namespace nacre {
namespace {

struct Pixels {
    std::vector<glm::vec3> factors;
    std::vector<float> cosines;
};

float uniform(uint64_t& random)
{
    return static_cast<float>(static_cast<double>(nextRandom(random) >> 11) * 0x1p-53);
}

// Factors e^(trend (n.v - 1) + paint x), x even in [-1, 1], of slopes from 0.2 on; red alone goes with the slope.
Pixels pixelsOf(float trend, float paint)
{
    Pixels pixels;
    uint64_t random = 1;
    for (int i = 0; i < 4000; ++i) {
        const float cosine = 0.2f + 0.8f * uniform(random), own = std::exp(paint * (2 * uniform(random) - 1));
        pixels.cosines.push_back(cosine);
        pixels.factors.push_back(own * glm::vec3(std::exp(trend * (cosine - 1)), 1, 1));
    }
    return pixels;
}

TEST(SlopeTrend, WhatGoesWithTheSlopeIsFoundChannelByChannel)
{
    const Pixels pixels = pixelsOf(2, 0.02f);
    const std::optional<SlopeTrend> trend = SlopeTrend::of(pixels.factors, pixels.cosines);
    ASSERT_TRUE(trend.has_value());
    for (const float cosine : {0.3f, 0.5f, 0.7f, 0.9f}) {
        const glm::vec3 relative = trend->at(cosine) / trend->at(0.6f);
        // Bins of 1/16 on an exponential and medians of 250 pixels with 2 % of paint: half a percent, and a reserve.
        EXPECT_NEAR(relative.x, std::exp(2 * (cosine - 0.6f)), 0.015 * relative.x);
        EXPECT_NEAR(relative.y, 1, 0.005);
    }
}

TEST(SlopeTrend, PaintThatKnowsNothingOfSlopesStaysInTheFactors)
{
    const Pixels painted = pixelsOf(0, 0.3f), mostlyPainted = pixelsOf(0.5f, 0.3f);
    EXPECT_FALSE(SlopeTrend::of(painted.factors, painted.cosines).has_value());
    EXPECT_FALSE(SlopeTrend::of(mostlyPainted.factors, mostlyPainted.cosines).has_value());
}

TEST(SlopeTrend, BlackAndMissingPixelsTellNothing)
{
    Pixels pixels = pixelsOf(2, 0.02f);
    for (size_t i = 0; i < pixels.factors.size(); i += 2) {
        pixels.factors[i] = glm::vec3(1, 0, 1);
    }
    const std::optional<SlopeTrend> trend = SlopeTrend::of(pixels.factors, pixels.cosines);
    ASSERT_TRUE(trend.has_value());
    EXPECT_TRUE(std::isfinite(trend->at(0).x) && trend->at(0).x > 0); // no pixel is as slanted
    EXPECT_FALSE(SlopeTrend::of({}, {}).has_value());
}

// Two faces of a box, each in its own colour: that goes with the slope as well as any trend does.
TEST(SlopeTrend, FacesKeepTheirColoursWhereNobodySaidThatAllPixelsShareAnAlbedo)
{
    const int side = 20;
    NormalMap normals(2 * side, side);
    Image albedo(2 * side, side, 3);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < 2 * side; ++x) {
            const size_t i = normals.index(x, y);
            normals.normals[i] = x < side ? glm::vec3(0, 0, 1) : glm::vec3(0.8f, 0, 0.6f);
            normals.confidence[i] = 1;
            albedo.setRgb(x, y, glm::vec3(x < side ? 0.2f : 0.7f));
        }
    }
    const std::vector<uint8_t> labels(normals.normals.size(), 0);
    const LocalLights lights(std::vector<Light>{});
    const std::vector<float> before = albedo.values;
    EXPECT_EQ(takeSlopeTrends(normals, lights, labels, std::vector<uint8_t>{0}, albedo), std::vector<uint8_t>{0});
    EXPECT_EQ(albedo.values, before);
    EXPECT_EQ(takeSlopeTrends(normals, lights, labels, std::vector<uint8_t>{1}, albedo), std::vector<uint8_t>{1});
    EXPECT_NEAR(albedo.rgb(0, 0).x, albedo.rgb(2 * side - 1, 0).x, 1e-5);
}

} // namespace
} // namespace nacre
