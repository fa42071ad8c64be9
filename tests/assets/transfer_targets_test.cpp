// The two transfer targets: that they are normal maps in our convention. What they look like is for eyes.
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "assets/statue_head.h"
#include "assets/woven_cloth.h"

namespace nacre {
namespace {

void expectUnitAndCameraFacing(const NormalMap& map)
{
    for (size_t i = 0; i < map.normals.size(); ++i) {
        if (map.confidence[i] > 0.0f) {
            EXPECT_NEAR(glm::length(map.normals[i]), 1.0f, 1e-5f);
            EXPECT_GT(map.normals[i].z, 0.0f);
        } else {
            EXPECT_EQ(map.normals[i], glm::vec3(0));
        }
    }
}

glm::vec3 meanNormal(const NormalMap& map)
{
    glm::dvec3 sum(0);
    for (const glm::vec3& n : map.normals) {
        sum += glm::dvec3(n);
    }
    return glm::vec3(sum / static_cast<double>(map.normals.size()));
}

// Empty pixels that no path of empty pixels joins to the border: holes in the bust.
size_t enclosedEmptyPixels(const NormalMap& map)
{
    std::vector<uint8_t> open(map.confidence.size(), 0);
    std::vector<std::pair<int, int>> front;
    auto visit = [&](int x, int y) {
        if (x >= 0 && y >= 0 && x < map.width && y < map.height && map.confidence[map.index(x, y)] == 0.0f &&
            !open[map.index(x, y)]) {
            open[map.index(x, y)] = 1;
            front.emplace_back(x, y);
        }
    };
    for (int x = 0; x < map.width; ++x) {
        visit(x, 0);
    }
    while (!front.empty()) {
        auto [x, y] = front.back();
        front.pop_back();
        visit(x + 1, y), visit(x - 1, y), visit(x, y + 1), visit(x, y - 1);
    }
    size_t enclosed = 0;
    for (size_t i = 0; i < open.size(); ++i) {
        enclosed += map.confidence[i] == 0.0f && !open[i];
    }
    return enclosed;
}

TEST(WovenCloth, CoversThePictureWithYarnsInBothDirections)
{
    NormalMap cloth = wovenCloth(192, 128);
    ASSERT_EQ(cloth.normals.size(), 192u * 128u);
    expectUnitAndCameraFacing(cloth);
    double squareX = 0, squareY = 0;
    for (size_t i = 0; i < cloth.normals.size(); ++i) {
        EXPECT_EQ(cloth.confidence[i], 1.0f);
        squareX += cloth.normals[i].x * cloth.normals[i].x;
        squareY += cloth.normals[i].y * cloth.normals[i].y;
    }
    const double count = static_cast<double>(cloth.normals.size());
    // Warp yarns lean left and right, weft yarns up and down: neither may be flat, and neither rules alone.
    EXPECT_GT(squareX / count, 0.05);
    EXPECT_GT(squareY / count, 0.05);
    EXPECT_NEAR(squareX / squareY, 1.0, 0.8);
    EXPECT_GT(meanNormal(cloth).z, 0.6f) << "seen from the front";
}

TEST(WovenCloth, DoesNotDependOnThreads)
{
    WovenClothOptions options;
    options.threads = 1;
    NormalMap one = wovenCloth(64, 64, options);
    options.threads = 2;
    EXPECT_EQ(one.normals, wovenCloth(64, 64, options).normals);
}

TEST(StatueHead, IsOneSolidInFrontOfNothing)
{
    NormalMap statue = statueHead(128, 128);
    expectUnitAndCameraFacing(statue);
    size_t seen = 0;
    for (float confidence : statue.confidence) {
        seen += confidence > 0.0f;
    }
    EXPECT_GT(seen, 128u * 128u / 4);
    EXPECT_LT(seen, 128u * 128u * 2 / 3);
    EXPECT_EQ(enclosedEmptyPixels(statue), 0u);
    for (int i = 0; i < 128; ++i) {
        EXPECT_EQ(statue.confidence[statue.index(i, 0)], 0.0f);
        EXPECT_EQ(statue.confidence[statue.index(0, i)], 0.0f);
        EXPECT_EQ(statue.confidence[statue.index(127, i)], 0.0f);
    }
}

TEST(StatueHead, DoesNotDependOnThreads)
{
    StatueHeadOptions options;
    options.threads = 1;
    NormalMap one = statueHead(64, 64, options);
    options.threads = 2;
    EXPECT_EQ(one.normals, statueHead(64, 64, options).normals);
}

} // namespace
} // namespace nacre
