#include "acquisition/lights/well_spread_lights.h"

#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/files/error.h"
#include "engine/files/measures.h"
#include "tests/support/expect_error.h"

namespace nacre {
namespace {

std::vector<Light> scatteredLights(size_t count)
{
    std::vector<Light> lights(count);
    for (size_t i = 0; i < count; ++i) {
        const float k = static_cast<float>(i);
        lights[i].direction = glm::normalize(glm::vec3(std::sin(12.9898f * k), std::cos(78.233f * k), 1.2f));
    }
    return lights;
}

double smallestAngle(const std::vector<Light>& lights, const std::vector<size_t>& chosen)
{
    double smallest = 180;
    for (size_t a = 0; a < chosen.size(); ++a) {
        for (size_t b = 0; b < a; ++b) {
            smallest = std::min(smallest, degreesBetween(lights[chosen[a]].direction, lights[chosen[b]].direction));
        }
    }
    return smallest;
}

TEST(WellSpreadLights, AreDistinctAscendingAndBeginWithTheFirst)
{
    const std::vector<Light> lights = scatteredLights(40);
    for (const size_t count : {3, 12, 39, 40}) {
        const std::vector<size_t> chosen = chosenLights(lights, {count, 0});
        ASSERT_EQ(chosen.size(), count);
        EXPECT_EQ(chosen.front(), 0u);
        EXPECT_TRUE(std::adjacent_find(chosen.begin(), chosen.end(), std::greater_equal<>()) == chosen.end());
    }
}

// Gonzalez: every light is within the largest spacing of a chosen one, which is at most the spacing of those chosen.
TEST(WellSpreadLights, LeaveNoLightFurtherAwayThanTheyStandApart)
{
    const std::vector<Light> lights = scatteredLights(60);
    for (const size_t count : {4, 10, 25}) {
        const std::vector<size_t> chosen = chosenLights(lights, {count, 0});
        double furthest = 0;
        for (const Light& light : lights) {
            double nearest = 180;
            for (const size_t c : chosen) {
                nearest = std::min(nearest, degreesBetween(light.direction, lights[c].direction));
            }
            furthest = std::max(furthest, nearest);
        }
        // Float directions: a ten-thousandth of a degree.
        EXPECT_LE(furthest, smallestAngle(lights, chosen) + 1e-4);
        EXPECT_GT(smallestAngle(lights, chosen), 0);
    }
}

TEST(WellSpreadLights, FewerAreAPartOfMore)
{
    const std::vector<Light> lights = scatteredLights(50);
    const std::vector<size_t> few = chosenLights(lights, {8, 0}), more = chosenLights(lights, {20, 0});
    EXPECT_TRUE(std::includes(more.begin(), more.end(), few.begin(), few.end()));
}

TEST(WellSpreadLights, AreNotHeldOut)
{
    const std::vector<Light> lights = scatteredLights(96);
    const std::vector<size_t> all = chosenLights(lights, {0, 7});
    EXPECT_EQ(all.size(), 82u);
    const std::vector<size_t> some = chosenLights(lights, {12, 7});
    EXPECT_EQ(some.front(), 1u) << "the first that is not held out";
    for (const size_t i : some) {
        EXPECT_NE(i % 7, 0u);
    }
    EXPECT_TRUE(isHeldOutOfEvery(0, 7) && isHeldOutOfEvery(7, 7) && !isHeldOutOfEvery(6, 7));
    EXPECT_FALSE(isHeldOutOfEvery(0, 0));
}

TEST(WellSpreadLights, RefusesFewerThanThreeAndMoreThanThereAre)
{
    const std::vector<Light> lights = scatteredLights(10);
    expectError([&] { chosenLights(lights, {2, 0}); }, {"2 lights given", "3 to 10"}, Error::kUsage);
    expectError([&] { chosenLights(lights, {11, 0}); }, {"11 lights given", "3 to 10"}, Error::kUsage);
    expectError([&] { chosenLights(lights, {9, 5}); }, {"3 to 8", "not held out"}, Error::kUsage);
}

TEST(WellSpreadLights, TakeTheirPhotographsAndTheirCalibrationAlong)
{
    Capture capture;
    Rig rig;
    rig.lights = scatteredLights(6);
    for (const char* name : {"a", "b", "c", "d", "e", "f"}) {
        capture.photographs.push_back({name, {}});
        rig.shadingDisagreement.push_back(static_cast<float>(capture.photographs.size()));
    }
    const std::vector<size_t> chosen = {1, 3, 4};
    const Capture given = selectPhotographs(capture, chosen);
    const Rig ofGiven = selectLights(rig, chosen);
    ASSERT_EQ(given.photographs.size(), 3u);
    EXPECT_EQ(given.photographs[1].name, "d");
    EXPECT_TRUE(given.lights.empty()) << "lights that have to be calibrated stay so";
    EXPECT_EQ(ofGiven.lights[2].direction, rig.lights[4].direction);
    EXPECT_EQ(ofGiven.shadingDisagreement, (std::vector<float>{2, 4, 5}));
    EXPECT_DOUBLE_EQ(ofGiven.condition, conditionOf(ofGiven.lights));
}

} // namespace
} // namespace nacre
