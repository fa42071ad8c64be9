#include "evaluation/stress/light_layouts.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/lights/lights.h"
#include "engine/files/measures.h"

namespace nacre {
namespace {

TEST(LightLayouts, AreUnitAndAsManyAsAskedFor)
{
    for (const size_t count : {3, 4, 36}) {
        for (const auto& lights :
             {spreadLights(count, 55), ringLights(count, 45), arcLights(count, 2), crossedLights(count)}) {
            ASSERT_EQ(lights.size(), count);
            for (const Light& light : lights) {
                EXPECT_NEAR(glm::length(light.direction), 1, 1e-6);
                EXPECT_GT(light.direction.z, 0);
            }
        }
    }
}

TEST(LightLayouts, HaveTheRankThatTheyClaim)
{
    // Float directions: a plane is one to about a millionth.
    EXPECT_GT(conditionOf(arcLights(36, 0)), 1e6);
    double last = 1e9;
    for (const double beside : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0}) {
        const double condition = conditionOf(arcLights(36, beside));
        EXPECT_LT(condition, last) << beside;
        // All singular values but the smallest stay; that one is the sine of the angle beside the plane.
        EXPECT_NEAR(condition * std::sin(glm::radians(beside)), 0.88, 0.1) << beside;
        last = condition;
    }
    EXPECT_LT(conditionOf(spreadLights(36, 55)), 3.5);
    EXPECT_LT(conditionOf(spreadLights(3, 55)), 20);
    EXPECT_LT(conditionOf(ringLights(36, 45)), 1.5);
    EXPECT_LT(conditionOf(crossedLights(36)), 3.5);
    // A ring of polar angle t has singular values cos t and sin t / sqrt 2.
    EXPECT_NEAR(conditionOf(ringLights(36, 10)), std::sqrt(2.0) / std::tan(glm::radians(10.0)), 0.01);
}

TEST(LightLayouts, SpreadLightsFillTheirCapAndNoMore)
{
    const glm::vec3 centre = glm::normalize(glm::vec3(0.5f, 0.2f, 0.8f));
    double largest = 0;
    for (const Light& light : spreadLights(100, 30, centre)) {
        largest = std::max(largest, degreesBetween(light.direction, centre));
    }
    EXPECT_LT(largest, 30);
    EXPECT_GT(largest, 29);
}

} // namespace
} // namespace nacre
