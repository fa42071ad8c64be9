// Cast shadows of heights, against geometry and against rays.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/surface/horizon.h"

namespace nacre {
namespace {

const float kDegree = kPi / 180;

glm::vec3 lightAt(float azimuthDegrees, float elevationDegrees)
{
    const float a = azimuthDegrees * kDegree, e = elevationDegrees * kDegree;
    return {std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e)};
}

struct Heights {
    NormalMap normals; // all that matters of them is where they are
    Image height;

    template <class Function> Heights(int width, int h, Function&& z) : normals(width, h), height(width, h, 1)
    {
        for (int y = 0; y < h; ++y) {
            for (int x = 0; x < width; ++x) {
                normals.normals[normals.index(x, y)] = {0, 0, 1};
                normals.confidence[normals.index(x, y)] = 1;
                height.at(x, y) = z(static_cast<float>(x), static_cast<float>(y));
            }
        }
    }
};

std::vector<float> shares(const HorizonMap& map, const glm::vec3& light)
{
    const glm::vec4 lookup = horizonLookup(light, map.azimuths);
    std::vector<float> lit(map.pixelCount());
    for (size_t i = 0; i < lit.size(); ++i) {
        lit[i] = visibilityOf(map, lookup, i);
    }
    return lit;
}

bool allLit(const std::vector<float>& share)
{
    return std::all_of(share.begin(), share.end(), [](float s) { return s == 1; });
}

// Hills of random places, breadths and heights, overlapping, some of them steep.
float bumps(float x, float y)
{
    uint32_t state = 7;
    const auto next = [&state] {
        state = state * 1664525u + 1013904223u; // Numerical Recipes' generator
        return static_cast<float>(state >> 8) / 16777216.0f;
    };
    float z = 0;
    for (int i = 0; i < 60; ++i) {
        const float cx = 256 * next(), cy = 256 * next(), radius = 3 + 17 * next(),
                    height = radius * (0.4f + 1.1f * next());
        const float square = ((x - cx) * (x - cx) + (y - cy) * (y - cy)) / (radius * radius);
        z += height * std::exp(-2 * square);
    }
    return z;
}

float bilinear(const Image& image, float x, float y)
{
    const int left = std::clamp(static_cast<int>(x), 0, image.width - 2);
    const int top = std::clamp(static_cast<int>(y), 0, image.height - 2);
    const float u = x - left, v = y - top;
    return (1 - v) * ((1 - u) * image.at(left, top) + u * image.at(left + 1, top)) +
           v * ((1 - u) * image.at(left, top + 1) + u * image.at(left + 1, top + 1));
}

// Whether a ray over the bilinear height arrives; steps of a quarter pixel.
bool arrives(const Image& height, int x, int y, const glm::vec3& light)
{
    const float across = std::hypot(light.x, light.y);
    const float right = light.x / across, down = -light.y / across, rise = light.z / across;
    for (float t = 0.25f;; t += 0.25f) {
        const float u = x + t * right, v = y + t * down;
        if (u < 0 || v < 0 || u > height.width - 1 || v > height.height - 1) {
            return true;
        }
        if (bilinear(height, u, v) > height.at(x, y) + t * rise + 1e-3f) {
            return false;
        }
    }
}

TEST(Horizon, APlaneCastsNothing)
{
    const Heights flat(40, 30, [](float, float) { return 5.0f; });
    const HorizonMap map = horizonMap(flat.normals, flat.height);
    for (const float azimuth : {0.0f, 17.0f, 90.0f, 201.0f, 333.0f}) {
        for (const float elevation : {0.5f, 10.0f, 89.9f}) {
            EXPECT_TRUE(allLit(shares(map, lightAt(azimuth, elevation)))) << azimuth << " " << elevation;
        }
    }
    EXPECT_TRUE(allLit(shares(map, {0, 0, 1})));
}

// A tilted plane is dark where it faces away, which the cosine says as well; a light that stands above it reaches all.
TEST(Horizon, ATiltedPlaneCastsNothing)
{
    for (const float azimuth : {0.0f, 6.0f, 40.0f, 100.0f, 250.0f}) {
        const glm::vec3 uphill = lightAt(azimuth, 0);
        const Heights plane(64, 64, [&](float x, float y) { return 0.6f * (x * uphill.x - y * uphill.y); });
        const glm::vec3 normal = glm::normalize(glm::vec3(-0.6f * uphill.x, -0.6f * uphill.y, 1));
        const HorizonMap map = horizonMap(plane.normals, plane.height);
        for (int turn = 0; turn < 360; turn += 7) {
            const glm::vec3 light = lightAt(static_cast<float>(turn), 35);
            // Its 31 degrees are rounded to at most a quarter and lit from half a degree above.
            if (glm::dot(normal, light) > 0.01f) {
                EXPECT_TRUE(allLit(shares(map, light))) << azimuth << " " << turn;
            }
        }
    }
}

// Half of the shadow's border lies within a pixel of where geometry has it: rounding to 8 bits moves an edge of 30
// pixels by at most 0.4 pixels, linear interpolation between 32 azimuths by 0.15, and a wall on pixels stands at a half
// one.
TEST(Horizon, AStepCastsItsLength)
{
    constexpr float kHigh = 20;
    const Heights step(160, 160, [](float x, float) { return x >= 100 ? kHigh : 0.0f; });
    const HorizonMap map = horizonMap(step.normals, step.height);
    for (const float azimuth : {0.0f, 5.6f, 11.25f, 18.0f, 30.0f, -7.0f, -22.5f, -39.0f}) {
        for (const float elevation : {25.0f, 35.0f, 50.0f}) {
            const std::vector<float> lit = shares(map, lightAt(azimuth, elevation));
            float shadow = 0; // pixels of row 80 along x, up to the edge of the first pixel on the step
            for (int x = 0; x < 100; ++x) {
                shadow += 1 - lit[step.normals.index(x, 80)];
            }
            const float length = kHigh / std::tan(elevation * kDegree); // along the light
            EXPECT_NEAR(shadow, length * std::cos(azimuth * kDegree), 1) << azimuth << " " << elevation;
            EXPECT_EQ(lit[step.normals.index(120, 80)], 1);
        }
    }
}

// The same step in all four directions: no axis is mirrored or exchanged.
TEST(Horizon, ShadowsFallAwayFromTheLight)
{
    const Heights post(41, 41, [](float x, float y) { return x == 20 && y == 20 ? 10.0f : 0.0f; });
    const HorizonMap map = horizonMap(post.normals, post.height);
    const auto lit = [&](float azimuth, int x, int y) {
        return shares(map, lightAt(azimuth, 45))[post.normals.index(x, y)];
    };
    EXPECT_EQ(lit(0, 15, 20), 0) << "light from the right";
    EXPECT_EQ(lit(0, 25, 20), 1);
    EXPECT_EQ(lit(90, 20, 25), 0) << "light from above: the shadow falls down the picture";
    EXPECT_EQ(lit(90, 20, 15), 1);
    EXPECT_EQ(lit(180, 25, 20), 0);
    EXPECT_EQ(lit(270, 20, 15), 0);
    EXPECT_EQ(lit(45, 16, 24), 0);
    EXPECT_EQ(lit(45, 24, 16), 1);
}

// A hemisphere of 30 pixels: a point of the plane is dark where its way to the light comes nearer than that to the
// middle.
TEST(Horizon, AHemisphereCastsItsEllipse)
{
    constexpr float kRadius = 30;
    const auto squareFromMiddle = [](float x, float y) { return (x - 120) * (x - 120) + (y - 120) * (y - 120); };
    const Heights dome(241, 241, [&](float x, float y) {
        return std::sqrt(std::max(0.0f, kRadius * kRadius - squareFromMiddle(x, y)));
    });
    const HorizonMap map = horizonMap(dome.normals, dome.height);
    for (const float azimuth : {0.0f, 33.0f, 73.1f, 160.0f, 275.6f}) {
        const glm::vec3 light = lightAt(azimuth, 30);
        const std::vector<float> lit = shares(map, light);
        int dark = 0, wrong = 0;
        for (int y = 0; y < 241; ++y) {
            for (int x = 0; x < 241; ++x) {
                const glm::vec3 place(x - 120, 120 - y, 0);
                const float along = glm::dot(place, light);
                const float passed = std::sqrt(glm::dot(place, place) - along * along);
                if (squareFromMiddle(x, y) <= kRadius * kRadius || std::abs(passed - kRadius) < 1) {
                    continue;
                }
                const bool isDark = along < 0 && passed < kRadius;
                dark += isDark;
                wrong += isDark != (lit[dome.normals.index(x, y)] < 0.5f);
            }
        }
        EXPECT_LT(wrong, 0.02 * dark) << azimuth; // 3000 dark pixels; two per cent are half a pixel around the ellipse
    }
}

double shareThatDiffers(const Heights& heights, int azimuths)
{
    const HorizonMap map = horizonMap(heights.normals, heights.height, azimuths);
    size_t differing = 0, all = 0;
    for (const float azimuth :
         {3.0f, 37.7f, 62.3f, 97.0f, 128.6f, 151.1f, 184.2f, 218.0f, 245.5f, 275.0f, 313.4f, 339.3f}) {
        for (const float elevation : {15.0f, 30.0f, 50.0f}) {
            const glm::vec3 light = lightAt(azimuth, elevation);
            const std::vector<float> lit = shares(map, light);
            for (int y = 0; y < 256; y += 5) {
                for (int x = 0; x < 256; x += 5) {
                    differing += (lit[heights.normals.index(x, y)] > 0.5f) != arrives(heights.height, x, y, light);
                    ++all;
                }
            }
        }
    }
    return static_cast<double>(differing) / static_cast<double>(all);
}

TEST(Horizon, IsWhatRaysFind)
{
    const Heights hills(256, 256, bumps);
    for (const int azimuths : {16, 32, 64}) {
        const double share = shareThatDiffers(hills, azimuths);
        RecordProperty("differing_" + std::to_string(azimuths), std::to_string(100 * share));
        std::printf("%d azimuths: %.3f %% of the pixels differ\n", azimuths, 100 * share);
    }
    // The border of a shadow between two azimuths is what differs.
    EXPECT_LT(shareThatDiffers(hills, kHorizonAzimuths), 0.02);
}

// What is not on the surface neither casts nor receives, whatever its height.
TEST(Horizon, PixelsWithoutANormalCastNothing)
{
    Heights wall(60, 40, [](float x, float) { return x >= 30 && x < 34 ? 50.0f : 0.0f; });
    for (int y = 0; y < 40; ++y) {
        for (int x = 30; x < 34; ++x) {
            wall.normals.confidence[wall.normals.index(x, y)] = 0;
        }
    }
    const HorizonMap map = horizonMap(wall.normals, wall.height);
    for (const float azimuth : {0.0f, 20.0f, 90.0f, 170.0f, 300.0f}) {
        EXPECT_TRUE(allLit(shares(map, lightAt(azimuth, 10)))) << azimuth;
    }
}

// The rim of a ball is lit from behind: a horizon that falls away is no plane.
TEST(Horizon, LightsFromBehindReachWhatFallsAway)
{
    Heights ball(101, 101, [](float x, float y) {
        return std::sqrt(std::max(0.0f, 2500 - (x - 50) * (x - 50) - (y - 50) * (y - 50)));
    });
    for (size_t i = 0; i < ball.height.values.size(); ++i) {
        ball.normals.confidence[i] = ball.height.values[i] > 0 ? 1 : 0;
    }
    const std::vector<float> lit = shares(horizonMap(ball.normals, ball.height), lightAt(0, -20));
    EXPECT_EQ(lit[ball.normals.index(98, 50)], 1);
    EXPECT_EQ(lit[ball.normals.index(50, 50)], 0);
}

TEST(Horizon, IsTheSameBytesForAnyNumberOfThreads)
{
    const Heights hills(96, 131, bumps);
    const HorizonMap one = horizonMap(hills.normals, hills.height, kHorizonAzimuths, 1);
    EXPECT_EQ(one.codes, horizonMap(hills.normals, hills.height, kHorizonAzimuths, 2).codes);
    EXPECT_EQ(one.codes, horizonMap(hills.normals, hills.height, kHorizonAzimuths, 5).codes);
}

TEST(Horizon, PictureOfOnePixelOrOneRow)
{
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {9, 1}}) {
        const Heights line(width, height, [](float x, float y) { return x + y; });
        const HorizonMap map = horizonMap(line.normals, line.height);
        for (const float share : shares(map, lightAt(70, 60))) {
            EXPECT_EQ(share, 1);
        }
    }
}

} // namespace
} // namespace nacre
