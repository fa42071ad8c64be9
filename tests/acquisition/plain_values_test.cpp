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

TEST(PlainValues, OfAMaskOfTheBackgroundIsTold)
{
    constexpr int kSide = 20;
    const auto masked = [](bool inside, int hole) { // a square in the middle
        std::vector<uint8_t> mask(kSide * kSide, inside ? 0 : 1);
        for (int y = 0; y < hole; ++y) {
            std::fill_n(mask.begin() + ((kSide - hole) / 2 + y) * kSide + (kSide - hole) / 2, hole, inside ? 1 : 0);
        }
        return checkMaskBorder(mask, kSide, kSide).findings;
    };
    EXPECT_TRUE(masked(true, 10).empty()) << "an object in the middle";
    EXPECT_TRUE(masked(true, kSide).empty()) << "one that fills the picture";
    EXPECT_TRUE(masked(false, 4).empty()) << "and has a hole";
    ASSERT_EQ(masked(false, 10).size(), 1u);
    EXPECT_EQ(masked(false, 10)[0].code, FindingCode::maskInverted);
}

TEST(PlainValues, OfAMaskThatIsDarkUnderEveryLightIsTold)
{
    Observations seen = observed(someLights());
    EXPECT_TRUE(checkMask(seen, true).findings.empty());
    EXPECT_TRUE(checkMask(seen, false).findings.empty());
    std::fill_n(seen.radiance.begin(), seen.radiance.size() / 5, glm::vec3(0.004f));
    EXPECT_TRUE(checkMask(seen, true).findings.empty()) << "a dark part of the object";
    EXPECT_NE(checkMask(seen, false).findings.at(0).text.find("--mask"), std::string::npos) << "a background";
    std::fill_n(seen.radiance.begin(), seen.radiance.size() / 5, glm::vec3(0.0004f));
    const std::vector<Finding> found = checkMask(seen, true).findings;
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].code, FindingCode::maskDark);
    EXPECT_NE(found[0].text.find("20 %"), std::string::npos) << found[0].text;
}

TEST(PlainValues, PhotographsThatHardlyDifferAreTold)
{
    const std::vector<Light> lights = someLights();
    for (const float ambient : {0.0f, 0.3f}) {
        EXPECT_TRUE(checkDifferences(observed(lights, ambient), lights).findings.empty()) << ambient;
    }
    for (const float ambient : {0.9f, 1.0f}) {
        const std::vector<Finding> found = checkDifferences(observed(lights, ambient), lights).findings;
        ASSERT_EQ(found.size(), 1u) << ambient;
        EXPECT_EQ(found[0].code, FindingCode::photographsAlike);
    }
    const std::vector<Light> ring = {{{0.6f, 0, 0.8f}, glm::vec3(1)},
                                     {{-0.6f, 0, 0.8f}, glm::vec3(1)},
                                     {{0, 0.6f, 0.8f}, glm::vec3(1)},
                                     {{0, -0.6f, 0.8f}, glm::vec3(1)}};
    EXPECT_TRUE(checkDifferences(observed(ring, 0.9f), ring).findings.empty()) << "lights that ask for no difference";
}

} // namespace
} // namespace nacre
