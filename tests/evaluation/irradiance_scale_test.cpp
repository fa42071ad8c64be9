#include "evaluation/held_out/irradiance_scale.h"

#include <cmath>

#include <gtest/gtest.h>

namespace nacre {
namespace {

std::vector<Light> ring(int count)
{
    std::vector<Light> lights;
    for (int i = 0; i < count; ++i) {
        const float angle = 6.2831853f * static_cast<float>(i) / static_cast<float>(count), tilt = 0.3f + 0.05f * i;
        Light light;
        light.direction = {std::sin(tilt) * std::cos(angle), std::sin(tilt) * std::sin(angle), std::cos(tilt)};
        light.irradiance = glm::vec3(1.0f + 0.1f * i, 1, 0.5f);
        lights.push_back(light);
    }
    return lights;
}

// A factor of all and one that grows from side to side, another for each channel.
std::vector<Light> rescaled(std::vector<Light> lights)
{
    for (Light& light : lights) {
        for (int c = 0; c < 3; ++c) {
            light.irradiance[c] *= std::exp(0.7f + 0.2f * c + 0.5f * light.direction.x - 0.3f * c * light.direction.y);
        }
    }
    return lights;
}

TEST(IrradianceScale, ATrendOverTheDirectionsIsFoundForLightsFromElsewhere)
{
    const std::vector<Light> all = ring(9), truth = rescaled(all);
    const std::vector<Light> from(all.begin(), all.end() - 2), to(truth.begin(), truth.end() - 2);
    std::vector<Light> asked(all.end() - 2, all.end());
    bringToScale(from, to, asked);
    for (size_t i = 0; i < asked.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(asked[i].irradiance[c] / truth[7 + i].irradiance[c], 1, 1e-5); // float's rounding
        }
    }
}

TEST(IrradianceScale, GivenOnesKeepTheirRatiosWhereAFewWereCorrected)
{
    const std::vector<Light> all = ring(9);
    std::vector<Light> to = all, asked{all[8]};
    to[0].irradiance *= 1.4f;
    to[5].irradiance *= 0.7f;
    bringToMedianScale(all, to, asked);
    EXPECT_EQ(asked[0].irradiance, all[8].irradiance);
}

} // namespace
} // namespace nacre
