// Environments reduced to lights, soft lights, and lights that move.
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/lights/environment.h"
#include "engine/lights/light_motion.h"
#include "shared/glsl.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

Image constantEnvironment(float value)
{
    return Image(64, 32, 3, value);
}

glm::vec3 totalIrradiance(const std::vector<Light>& lights)
{
    glm::vec3 sum(0);
    for (const Light& light : lights) {
        sum += light.irradiance;
    }
    return sum;
}

TEST(Environment, EnergyIsKept)
{
    Image picture = constantEnvironment(0.5f);
    picture.setRgb(10, 12, {40, 20, 0});
    for (const int count : {1, 7, 64, 500}) {
        SCOPED_TRACE(count);
        const auto lights = lightsFromEnvironment({picture}, count);
        EXPECT_LE(lights.size(), static_cast<size_t>(count));
        EXPECT_GE(lights.size(), static_cast<size_t>(0.9 * count));
        // All but the degree straight behind, and float sums.
        EXPECT_NEAR(totalIrradiance(lights).z, 0.5f * 4 * kPi, 0.02f * 4 * kPi);
        EXPECT_GT(totalIrradiance(lights).x, totalIrradiance(lights).z);
    }
}

// Under constant radiance L a Lambertian plane receives E = pi L.
TEST(Environment, ConstantRadianceIrradiatesAPlaneByPi)
{
    const auto lights = lightsFromEnvironment({constantEnvironment(2)}, 400);
    for (const glm::vec3& n : {glm::vec3(0, 0, 1), glm::vec3(0, 1, 0), glm::vec3(0.6f, 0, 0.8f)}) {
        float irradiance = 0;
        for (const Light& light : lights) {
            irradiance += light.irradiance.x * std::max(0.0f, glm::dot(n, light.direction));
        }
        EXPECT_NEAR(irradiance, 2 * kPi, 0.02f * 2 * kPi);
    }
}

TEST(Environment, PlacesAreOpenExrs)
{
    const std::pair<glm::ivec2, glm::vec3> places[] = {{{32, 16}, {0, 0, 1}}, // middle: the camera's side
                                                       {{16, 16}, {1, 0, 0}}, // a quarter from the left: right
                                                       {{32, 0}, {0, 1, 0}}}; // top: up
    for (const auto& [pixel, direction] : places) {
        Image picture = constantEnvironment(0);
        picture.setRgb(pixel.x, pixel.y, glm::vec3(1));
        const auto lights = lightsFromEnvironment({picture}, 16);
        ASSERT_EQ(lights.size(), 1u);
        // Half a pixel of 64 x 32 is 2.8 degrees each way.
        EXPECT_GT(glm::dot(lights[0].direction, direction), std::cos(0.08f));
        const auto turned = lightsFromEnvironment({picture}, 16, kHalfPi);
        EXPECT_NEAR(turned[0].direction.x, lights[0].direction.z, 1e-5f);
    }
}

TEST(Environment, BlackGivesNoLight)
{
    EXPECT_TRUE(lightsFromEnvironment({constantEnvironment(0)}, 16).empty());
}

TEST(Environment, OtherShapesAreRefused)
{
    const TempFolder folder;
    saveImage(folder / "square.exr", Image(8, 8, 3, 1), PixelType::float32);
    expectError([&] { loadEnvironment(folder / "square.exr"); }, {"8 x 8", "twice as wide as high"});
}

TEST(Environment, WhatIsNoRadianceIsClampedAndTold)
{
    const TempFolder folder;
    Image picture(8, 4, 3, 2.5f);
    picture.at(1, 0, 2) = -1;
    picture.at(3, 2, 0) = std::numeric_limits<float>::infinity();
    picture.at(4, 2, 0) = std::numeric_limits<float>::quiet_NaN();
    saveImage(folder / "sky.exr", picture, PixelType::float32);
    const Environment sky = loadEnvironment(folder / "sky.exr");
    EXPECT_EQ(sky.radiance.at(1, 0, 2), 0);
    EXPECT_EQ(sky.radiance.at(3, 2, 0), 2.5f);
    EXPECT_EQ(sky.radiance.at(4, 2, 0), 0);
    EXPECT_EQ(sky.radiance.at(4, 2, 1), 2.5f);
    EXPECT_EQ(sky.clamped, "3 values are negative or not finite, the first at pixel 1, 0: taken for 0 and 2.5");
}

TEST(SoftLight, IsTheLightSpread)
{
    const Light light{glm::normalize(glm::vec3(0.3f, -0.4f, 0.8f)), {1, 2, 3}};
    const auto bundle = softLight(light, 0.2f, 64);
    glm::vec3 mean(0);
    for (const Light& one : bundle) {
        EXPECT_GE(glm::dot(one.direction, light.direction), std::cos(0.2f));
        mean += one.direction / 64.0f;
    }
    EXPECT_NEAR(glm::length(totalIrradiance(bundle) - light.irradiance), 0, 1e-5f);
    EXPECT_GT(glm::dot(glm::normalize(mean), light.direction), 0.9999f);
}

TEST(LightMotion, TurntableComesRoundAndSweepPasses)
{
    const std::vector<Light> lights = {{glm::normalize(glm::vec3(0.5f, 0, 1)), {1, 1, 1}}};
    EXPECT_EQ(movedLights(lights, LightMotion::turntable, 0, 8), lights);
    EXPECT_NEAR(movedLights(lights, LightMotion::turntable, 2, 8)[0].direction.y, lights[0].direction.x, 1e-6f);
    EXPECT_NEAR(movedLights(lights, LightMotion::turntable, 4, 8)[0].direction.x, -lights[0].direction.x, 1e-6f);
    const std::vector<Light> front = {{{0, 0, 1}, {1, 1, 1}}};
    EXPECT_LT(movedLights(front, LightMotion::sweep, 0, 5)[0].direction.x, -0.8f);
    EXPECT_NEAR(movedLights(front, LightMotion::sweep, 2, 5)[0].direction.z, 1, 1e-6f);
    EXPECT_GT(movedLights(front, LightMotion::sweep, 4, 5)[0].direction.x, 0.8f);
    EXPECT_EQ(movedLights(front, LightMotion::none, 3, 5), front);
}

} // namespace
} // namespace nacre
