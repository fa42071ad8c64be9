#include "acquisition/checks/height_consistency.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "shared/glsl.h"

namespace nacre {
namespace {

constexpr int kSize = 80;

// Hills of three wavelengths, slopes up to about 1.
NormalMap hills()
{
    NormalMap map(kSize, kSize);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const float u = 0.11f * static_cast<float>(x), v = -0.08f * static_cast<float>(y);
            const float p = 0.5f * std::cos(u) + 0.4f * std::cos(u + 2 * v),
                        q = -0.5f * std::sin(v) + 0.8f * std::cos(u + 2 * v);
            map.normals[map.index(x, y)] = glm::normalize(glm::vec3(-0.11f * 8 * p, -0.08f * 8 * q, 1));
            map.confidence[map.index(x, y)] = 1;
        }
    }
    return map;
}

NormalMap changed(NormalMap map, const glm::mat3& change)
{
    for (glm::vec3& normal : map.normals) {
        normal = change * normal;
    }
    return map;
}

glm::mat3 turnAboutX(float degrees)
{
    const float c = std::cos(degrees * kPi / 180), s = std::sin(degrees * kPi / 180);
    return glm::mat3(1, 0, 0, 0, c, s, 0, -s, c);
}

TEST(HeightConsistency, NormalsOfAHeightAreLeftInPeace)
{
    const HeightConsistency found = heightConsistencyOf(hills());
    EXPECT_GT(found.places, 1000u);
    EXPECT_LT(*std::max_element(found.axesRatios.begin(), found.axesRatios.end()), 0.3);
    // Differences over two pixels of hills 57 pixels long are off by half a percent.
    EXPECT_LT(glm::length(found.turnDegrees), 1);
    EXPECT_TRUE(checkHeight(hills()).findings.empty());
}

// The normals of a ball whose lights were given by each of the eight symmetries of the picture's axes.
TEST(HeightConsistency, MixedUpAxesOfTheLightsAreNamed)
{
    const struct {
        glm::mat2 axes;
        const char* text;
    } cases[] = {{{1, 0, 0, -1}, "y reversed"},
                 {{-1, 0, 0, 1}, "x reversed"},
                 {{0, 1, 1, 0}, "x and y exchanged;"},
                 {{0, -1, -1, 0}, "x and y exchanged and reversed"},
                 {{0, 1, -1, 0}, "a quarter counter-clockwise"},
                 {{0, -1, 1, 0}, "a quarter clockwise"}};
    for (const auto& c : cases) {
        const std::vector<Finding> found = checkHeight(changed(sphereNormalMap(kSize), glm::mat3(c.axes))).findings;
        ASSERT_EQ(found.size(), 1u) << c.text;
        EXPECT_EQ(found[0].code, FindingCode::axesMixed);
        EXPECT_NE(found[0].text.find(c.text), std::string::npos) << found[0].text;
    }
    EXPECT_TRUE(checkHeight(sphereNormalMap(kSize)).findings.empty());
    const std::vector<Finding> hollow = checkHeight(changed(sphereNormalMap(kSize), glm::mat3(glm::mat2(-1)))).findings;
    ASSERT_EQ(hollow.size(), 1u);
    EXPECT_EQ(hollow[0].code, FindingCode::hollow);
}

TEST(HeightConsistency, ATurnOfAllNormalsIsFoundAndSaid)
{
    const NormalMap map = changed(hills(), turnAboutX(8));
    EXPECT_NEAR(glm::length(heightConsistencyOf(map).turnDegrees), 8, 1);
    ASSERT_EQ(checkHeight(map).findings.size(), 1u);
    EXPECT_EQ(checkHeight(map).findings.front().code, FindingCode::lightsTurned);
    EXPECT_NE(checkHeight(map).findings.front().text.find("turned by 8 degrees"), std::string::npos)
        << checkHeight(map).findings.front().text;
}

TEST(HeightConsistency, FewPixelsSayNothing)
{
    EXPECT_TRUE(checkHeight(NormalMap(10, 10)).findings.empty());
}

} // namespace
} // namespace nacre
