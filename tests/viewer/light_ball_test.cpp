#include "engine/view_state/light_ball.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace nacre {
namespace {

TEST(LightBall, DiscAndLightAreInverses)
{
    for (float x = -0.9f; x < 1; x += 0.3f) {
        for (float y = -0.9f; y < 1; y += 0.3f) {
            const glm::vec2 disc(x, y);
            if (glm::length(disc) > std::sin(kMostPolar)) {
                continue;
            }
            const glm::vec3 light = lightFromBallDisc(disc);
            EXPECT_NEAR(glm::length(light), 1, 1e-6); // rounding of one square root
            EXPECT_GT(light.z, 0);
            EXPECT_LT(glm::distance(ballDiscFromLight(light), disc), 1e-6f);
        }
    }
}

TEST(LightBall, BeyondTheRimIsTheRim)
{
    const glm::vec3 far = lightFromBallDisc({30, 40});
    EXPECT_NEAR(std::acos(far.z), kMostPolar, 1e-4); // acos near its steep end
    EXPECT_NEAR(far.y / far.x, 4.0f / 3.0f, 1e-5);
    EXPECT_NEAR(glm::length(ballDiscFromLight({0, -1, -1})), 1, 1e-6) << "lights behind stand on the rim";
    EXPECT_LT(ballDiscFromLight({0, -1, -1}).y, 0);
}

TEST(LightBall, UpIsUpAndRightIsRight)
{
    EXPECT_GT(draggedLight({0, 0, 1}, {0.3f, 0}).x, 0.2f);
    EXPECT_GT(draggedLight({0, 0, 1}, {0, 0.3f}).y, 0.2f);
    EXPECT_LT(glm::distance(draggedLight({0, 0, 5}, {0, 0}), glm::vec3(0, 0, 1)), 1e-6f);
}

} // namespace
} // namespace nacre
