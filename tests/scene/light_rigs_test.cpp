// The presets' promises: what light comes from where, and how much.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/lights/light_rigs.h"
#include "shared/brdf_coords.h"
#include "tests/support/expect_error.h"

namespace nacre::test {
namespace {

constexpr glm::vec3 kView(0, 0, 1);

double polarDegrees(const Light& light)
{
    return glm::degrees(static_cast<double>(angleBetween(light.direction, kView)));
}

// On a plane that faces the viewer.
glm::dvec3 frontIrradiance(const std::vector<Light>& lights)
{
    glm::dvec3 sum(0);
    for (const Light& light : lights) {
        sum += glm::dvec3(light.irradiance) * std::max(0.0, static_cast<double>(light.direction.z));
    }
    return sum;
}

TEST(LightRigs, EveryPresetIsOfProperLightsThatReachTheFront)
{
    ASSERT_EQ(rigNames().size(), 5u);
    for (const std::string& name : rigNames()) {
        SCOPED_TRACE(name);
        const std::vector<Light> lights = lightsOfRig(name);
        ASSERT_FALSE(lights.empty());
        for (const Light& light : lights) {
            EXPECT_NEAR(glm::length(light.direction), 1, 1e-5);
            EXPECT_GE(std::min({light.irradiance.x, light.irradiance.y, light.irradiance.z}), 0);
        }
        const glm::dvec3 front = frontIrradiance(lights);
        EXPECT_GT(std::min({front.x, front.y, front.z}), 0.05) << "a front that stays black shows nothing";
        EXPECT_EQ(lightsOfRig(name), lights) << "the same every time";
    }
}

TEST(LightRigs, LightsComeFromWhereTheirNameSays)
{
    const Light key = lightsOfRig("key").at(0);
    EXPECT_LT(key.direction.x, 0);
    EXPECT_GT(key.direction.y, 0);
    EXPECT_GT(polarDegrees(lightsOfRig("raking").at(0)), 70) << "it grazes a flat piece";
    EXPECT_LT(polarDegrees(lightsOfRig("raking").at(0)), 90) << "and reaches it";
    const std::vector<Light> three = lightsOfRig("three-point");
    ASSERT_EQ(three.size(), 3u);
    EXPECT_LT(three[0].direction.x * three[1].direction.x, 0) << "the fill is on the other side";
    EXPECT_GT(three[0].irradiance.y, 3 * three[1].irradiance.y) << "and weaker";
    EXPECT_GT(three[0].irradiance.x, three[0].irradiance.z) << "a warm key";
    EXPECT_LT(three[1].irradiance.x, three[1].irradiance.z) << "a cool fill";
}

// A ring has no side: seen from the front, its light comes from the view itself.
TEST(LightRigs, ARingIsBalanced)
{
    const std::vector<Light> ring = lightsOfRig("ring");
    ASSERT_GE(ring.size(), 8u);
    glm::dvec3 sum(0);
    for (const Light& light : ring) {
        EXPECT_EQ(light.irradiance, ring[0].irradiance);
        EXPECT_NEAR(polarDegrees(light), polarDegrees(ring[0]), 0.01);
        sum += glm::dvec3(light.direction) * static_cast<double>(light.irradiance.x);
    }
    EXPECT_NEAR(sum.x, 0, 1e-5);
    EXPECT_NEAR(sum.y, 0, 1e-5);
}

// Without the part straight behind, which no light stands for (a degree: 0.02 % of the sphere).
TEST(LightRigs, TheEnvironmentsLightsHaveTheStudiosEnergy)
{
    const Environment studio = studioEnvironment();
    ASSERT_EQ(studio.radiance.width, 2 * studio.radiance.height);
    glm::dvec3 energy(0), lights(0);
    for (int y = 0; y < studio.radiance.height; ++y) {
        const double top = kPi * y / studio.radiance.height, bottom = kPi * (y + 1) / studio.radiance.height;
        const double solidAngle = 2 * kPi / studio.radiance.width * (std::cos(top) - std::cos(bottom));
        for (int x = 0; x < studio.radiance.width; ++x) {
            energy += glm::dvec3(studio.radiance.rgb(x, y)) * solidAngle;
        }
    }
    const std::vector<Light> environment = lightsOfRig("environment");
    EXPECT_GT(environment.size(), 100u) << "few lights would show one by one in a gloss";
    for (const Light& light : environment) {
        lights += glm::dvec3(light.irradiance);
    }
    EXPECT_NEAR(lights.x / energy.x, 1, 0.01);
    EXPECT_NEAR(lights.z / energy.z, 1, 0.01);
}

TEST(LightRigs, TheStudioIsLighterAboveAndOnItsLeft)
{
    const Environment studio = studioEnvironment();
    glm::dvec3 up(0), side(0);
    for (const Light& light : lightsFromEnvironment(studio, 256)) {
        up += glm::dvec3(light.irradiance) * static_cast<double>(light.direction.y);
        side += glm::dvec3(light.irradiance) * static_cast<double>(light.direction.x);
    }
    EXPECT_GT(up.y, 0.5);
    EXPECT_LT(side.y, 0) << "the larger box is on the left";
}

TEST(LightRigs, AnUnknownNameListsWhatThereIs)
{
    expectError([] { lightsOfRig("moonlight"); }, {"moonlight", "key", "three-point", "raking", "ring", "environment"},
                Error::kUsage);
}

} // namespace
} // namespace nacre::test
