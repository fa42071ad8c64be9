// What every transfer target has to be, by property. What they look like is for eyes.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "assets/targets.h"
#include "engine/files/measures.h"

namespace nacre {
namespace {

class TransferTarget : public testing::TestWithParam<const char*> {
protected:
    static Target make(int width, int height, int threads = 0)
    {
        return makeTarget(GetParam(), width, height, threads);
    }

    // Made once for all tests that only look at it.
    static const Target& at256()
    {
        static std::map<std::string, Target> made;
        auto found = made.find(GetParam());
        return found != made.end() ? found->second : made.emplace(GetParam(), make(256, 256)).first->second;
    }

    // Fibres are a few pixels wide at 256, so that a pixel's normal is the mean of many.
    static bool hasFibres()
    {
        const std::string name = GetParam();
        return name.starts_with("cloth") || name.starts_with("knit");
    }
};

bool hasData(const Target& target, int x, int y)
{
    return x >= 0 && y >= 0 && x < target.normals.width && y < target.normals.height &&
           target.normals.confidence[target.normals.index(x, y)] > 0;
}

const glm::vec3& normalAt(const Target& target, int x, int y)
{
    return target.normals.normals[target.normals.index(x, y)];
}

// All eight neighbours have data and normals within `degrees` of the pixel's.
bool isSmooth(const Target& target, int x, int y, double degrees)
{
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            if (!hasData(target, x + dx, y + dy) ||
                degreesBetween(normalAt(target, x, y), normalAt(target, x + dx, y + dy)) > degrees) {
                return false;
            }
        }
    }
    return true;
}

// Central differences; rows run downwards, y up.
glm::vec3 normalOfHeight(const Image& height, int x, int y)
{
    const float alongX = 0.5f * (height.at(x + 1, y) - height.at(x - 1, y));
    const float alongY = 0.5f * (height.at(x, y - 1) - height.at(x, y + 1));
    return glm::normalize(glm::vec3(-alongX, -alongY, 1));
}

using TransferTargetSlow = TransferTarget; // left out under the sanitizers

TEST_P(TransferTargetSlow, HasUnitNormalsFiniteHeightsAndNamedParts)
{
    const Target target = make(144, 96);
    ASSERT_EQ(target.normals.width, 144);
    ASSERT_EQ(target.height.height, 96);
    ASSERT_EQ(target.height.channels, 1);
    ASSERT_EQ(target.labels.size(), 144u * 96u);
    std::set<uint8_t> used;
    for (size_t i = 0; i < target.labels.size(); ++i) {
        const glm::vec3& n = target.normals.normals[i];
        ASSERT_TRUE(std::isfinite(target.height.values[i]));
        if (target.normals.confidence[i] > 0) {
            ASSERT_NEAR(glm::length(n), 1.0f, 1e-5f) << "pixel " << i; // float32 normalisation
            ASSERT_GE(n.z, 0.0f);
            ASSERT_LT(target.labels[i], target.parts.size());
            used.insert(target.labels[i]);
        } else {
            ASSERT_EQ(n, glm::vec3(0));
            ASSERT_EQ(target.height.values[i], 0.0f);
            ASSERT_EQ(target.labels[i], Target::kNoPart);
        }
    }
    // A sheet need not show its reverse.
    EXPECT_EQ(used.size(), target.parts.back() == "reverse" ? used.size() : target.parts.size());
    EXPECT_FALSE(used.empty());
    for (const std::string& part : target.parts) {
        EXPECT_FALSE(part.empty());
    }
    EXPECT_EQ(std::set<std::string>(target.parts.begin(), target.parts.end()).size(), target.parts.size());
}

TEST_P(TransferTarget, IsTheSameBytesForAnyNumberOfThreads)
{
    const Target one = make(80, 64, 1), two = make(80, 64, 2);
    EXPECT_EQ(one.normals.normals, two.normals.normals);
    EXPECT_EQ(one.normals.confidence, two.normals.confidence);
    EXPECT_EQ(one.height.values, two.height.values);
    EXPECT_EQ(one.labels, two.labels);
}

TEST_P(TransferTargetSlow, NormalsAreThoseOfItsHeight)
{
    const Target& target = at256();
    std::vector<float> errors;
    for (int y = 1; y < 255; ++y) {
        for (int x = 1; x < 255; ++x) {
            if (isSmooth(target, x, y, 20)) {
                errors.push_back(
                    static_cast<float>(degreesBetween(normalAt(target, x, y), normalOfHeight(target.height, x, y))));
            }
        }
    }
    ASSERT_GT(errors.size(), 200u);
    // Differences over two pixels of a surface that turns by up to 20 degrees a pixel are off by some; a flipped axis
    // or a height in another unit is off by tens.
    EXPECT_LT(quantile(errors, 0.5), hasFibres() ? 4.0f : 0.5f);
    EXPECT_LT(quantile(errors, 0.95), hasFibres() ? 10.0f : 2.5f);
}

// Mean size of the circulation of slopes around four neighbouring pixels: 0 for the gradient of a height.
double meanCurl(const Target& target, float greenSign)
{
    double sum = 0;
    size_t count = 0;
    for (int y = 1; y + 1 < target.normals.height; ++y) {
        for (int x = 1; x + 1 < target.normals.width; ++x) {
            // Slopes across contours and near the rim grow without bound.
            if (isSmooth(target, x, y, 15) && normalAt(target, x, y).z > 0.3f) {
                auto slopeX = [&](int dx, int dy) {
                    const glm::vec3& n = normalAt(target, x + dx, y + dy);
                    return -n.x / n.z;
                };
                auto slopeY = [&](int dx, int dy) {
                    const glm::vec3& n = normalAt(target, x + dx, y + dy);
                    return -greenSign * n.y / n.z;
                };
                sum += std::abs(slopeX(0, -1) - slopeX(0, 1) - slopeY(1, 0) + slopeY(-1, 0));
                ++count;
            }
        }
    }
    return sum / static_cast<double>(count);
}

TEST_P(TransferTargetSlow, IsIntegrableAndWouldNotBeWithGreenFlipped)
{
    const Target& target = at256();
    // Means of normals are not quite normals of means, so that some circulation is left in fine detail.
    EXPECT_LT(meanCurl(target, 1), (hasFibres() ? 0.7 : 0.15) * meanCurl(target, -1));
}

TEST_P(TransferTargetSlow, ScalesWithThePicture)
{
    const Target& large = at256();
    const Target small = make(128, 128);
    std::vector<float> errors, heights;
    for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 128; ++x) {
            glm::vec3 sum(0);
            float height = 0;
            int seen = 0;
            for (int s = 0; s < 4; ++s) {
                const int lx = 2 * x + s % 2, ly = 2 * y + s / 2;
                seen += hasData(large, lx, ly);
                sum += normalAt(large, lx, ly);
                height += 0.25f * large.height.at(lx, ly);
            }
            if (seen == 4 && hasData(small, x, y)) {
                errors.push_back(static_cast<float>(degreesBetween(glm::normalize(sum), normalAt(small, x, y))));
                heights.push_back(std::abs(0.5f * height - small.height.at(x, y)));
            }
        }
    }
    ASSERT_GT(errors.size(), 128u * 128u / 8);
    // Both are means over the same areas, of different samples.
    EXPECT_LT(quantile(errors, 0.5), 1.0f);
    EXPECT_LT(quantile(errors, 0.9), 4.0f);
    // Pixels of the small picture. The sphere's radius is half a pixel less than half the picture, whatever its size.
    EXPECT_LT(quantile(heights, 0.5), 0.5f);
}

std::string testName(const testing::TestParamInfo<const char*>& info)
{
    std::string name;
    std::copy_if(info.param, info.param + std::char_traits<char>::length(info.param), std::back_inserter(name),
                 [](char c) { return std::isalnum(static_cast<unsigned char>(c)); });
    return name;
}

const auto kTargets = testing::Values("cloth:threads=8", "cloth:twill,threads=6,curl=0.8", "cloth:satin5,threads=10",
                                      "cloth:satin8,threads=8,wander=0,drape=0", "knit:loops=5", "drape", "drape:ball",
                                      "head", "sphere", "letters");
INSTANTIATE_TEST_SUITE_P(All, TransferTarget, kTargets, testName);
INSTANTIATE_TEST_SUITE_P(All, TransferTargetSlow, kTargets, testName);

// Empty pixels that no path of empty pixels joins to the border: holes.
size_t enclosedEmptyPixels(const Target& target)
{
    const NormalMap& map = target.normals;
    std::vector<uint8_t> open(map.confidence.size(), 0);
    std::vector<std::pair<int, int>> front;
    auto visit = [&](int x, int y) {
        if (x >= 0 && y >= 0 && x < map.width && y < map.height && !hasData(target, x, y) && !open[map.index(x, y)]) {
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
        enclosed += map.confidence[i] == 0 && !open[i];
    }
    return enclosed;
}

TEST(StatueHeadSlow, IsOneSolidInFrontOfNothing)
{
    const Target statue = makeTarget("head", 192, 192);
    const auto& confidence = statue.normals.confidence;
    const auto seen = std::count_if(confidence.begin(), confidence.end(), [](float c) { return c > 0; });
    EXPECT_GT(seen, 192 * 192 / 4);
    EXPECT_LT(seen, 192 * 192 * 2 / 3);
    EXPECT_EQ(enclosedEmptyPixels(statue), 0u);
    for (int i = 0; i < 192; ++i) {
        EXPECT_FALSE(hasData(statue, i, 0) || hasData(statue, 0, i) || hasData(statue, 191, i));
    }
}

TEST(SphereTarget, HeightIsThatOfAHalfSphere)
{
    const Target sphere = makeTarget("sphere", 101, 101);
    EXPECT_NEAR(sphere.height.at(50, 50), 50, 1e-3);      // the rim passes through the border pixels' centres
    EXPECT_NEAR(sphere.height.at(50 + 30, 50), 40, 1e-3); // 30, 40, 50
}

} // namespace
} // namespace nacre
