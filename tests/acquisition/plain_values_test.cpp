#include "acquisition/checks/plain_values.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace nacre {
namespace {

std::vector<Light> someLights()
{
    std::vector<Light> lights;
    for (int i = 0; i < 12; ++i) {
        const float angle = 2.4f * static_cast<float>(i), tilt = 0.2f + 0.07f * static_cast<float>(i);
        lights.push_back(
            {{std::sin(tilt) * std::cos(angle), std::sin(tilt) * std::sin(angle), std::cos(tilt)}, glm::vec3(1)});
    }
    return lights;
}

// Lambert's law on normals at random, and a highlight at every seventh pixel.
Observations observed(const std::vector<Light>& lights, float ambient = 0)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<float> slope(-0.8f, 0.8f);
    Observations seen;
    seen.lightCount = lights.size();
    seen.width = 40;
    for (uint32_t p = 0; p < 1600; ++p) {
        seen.pixels.push_back(p);
        const glm::vec3 normal = glm::normalize(glm::vec3(slope(random), slope(random), 1));
        for (const Light& light : lights) {
            const float cosine = std::max(0.0f, glm::dot(normal, light.direction));
            const float value = ambient + (1 - ambient) * cosine * (p % 7 == 0 ? 1.5f : 0.6f);
            seen.radiance.push_back(glm::vec3(1, 0.8f, 0.5f) * std::round(value * 4095) / 4095.0f);
            seen.saturated.push_back(0);
        }
    }
    return seen;
}

TEST(PlainValues, AnEndBelowFullScaleIsFoundAndClippedAt)
{
    Observations seen = observed(someLights());
    EXPECT_FALSE(endOfValues(seen)) << "values that merely have a largest";
    const float top = 0.7f;
    for (glm::vec3& value : seen.radiance) {
        value.x = std::min(value.x, top);
    }
    const auto end = endOfValues(seen);
    ASSERT_TRUE(end);
    EXPECT_EQ(end->x, top);
    EXPECT_TRUE(std::isinf(end->y)) << "only red ends";
    clipAt(*end, seen);
    for (size_t k = 0; k < seen.radiance.size(); ++k) {
        ASSERT_EQ(seen.saturated[k], seen.radiance[k].x >= top ? 1 : 0);
    }
    EXPECT_FALSE(endOfValues(seen)) << "what is clipped is known";
}

TEST(PlainValues, OfAMaskThatIsDarkUnderEveryLightIsTold)
{
    Observations seen = observed(someLights());
    EXPECT_TRUE(maskWarnings(seen, true).empty());
    EXPECT_TRUE(maskWarnings(seen, false).empty());
    std::fill_n(seen.radiance.begin(), seen.radiance.size() / 5, glm::vec3(0.004f));
    EXPECT_TRUE(maskWarnings(seen, true).empty()) << "a dark part of the object";
    EXPECT_NE(maskWarnings(seen, false).at(0).text.find("--mask"), std::string::npos) << "a background";
    std::fill_n(seen.radiance.begin(), seen.radiance.size() / 5, glm::vec3(0.0004f));
    const std::vector<Finding> found = maskWarnings(seen, true);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].code, FindingCode::maskDark);
    EXPECT_NE(found[0].text.find("20 %"), std::string::npos) << found[0].text;
}

TEST(PlainValues, PhotographsThatHardlyDifferAreTold)
{
    const std::vector<Light> lights = someLights();
    for (const float ambient : {0.0f, 0.3f}) {
        EXPECT_TRUE(alikeWarnings(observed(lights, ambient), lights).empty()) << ambient;
    }
    for (const float ambient : {0.9f, 1.0f}) {
        const std::vector<Finding> found = alikeWarnings(observed(lights, ambient), lights);
        ASSERT_EQ(found.size(), 1u) << ambient;
        EXPECT_EQ(found[0].code, FindingCode::photographsAlike);
    }
    const std::vector<Light> ring = {{{0.6f, 0, 0.8f}, glm::vec3(1)},
                                     {{-0.6f, 0, 0.8f}, glm::vec3(1)},
                                     {{0, 0.6f, 0.8f}, glm::vec3(1)},
                                     {{0, -0.6f, 0.8f}, glm::vec3(1)}};
    EXPECT_TRUE(alikeWarnings(observed(ring, 0.9f), ring).empty()) << "lights that ask for no difference";
}

} // namespace
} // namespace nacre
