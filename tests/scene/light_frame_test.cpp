// The light's frame against the general formulas of brdf_coords.h, and the display's curves.
#include <cmath>

#include <gtest/gtest.h>

#include "shared/ball.h"
#include "shared/light_frame.h"
#include "shared/shading.h"
#include "shared/tone.h"

namespace nacre {
namespace {

// A deterministic direction; z is at least `lowest`.
vec3 direction(int i, float lowest)
{
    const float z = lowest + (1 - lowest) * std::fmod(0.5f + 0.754877f * i, 1.0f);
    const float azimuth = 2.3999632f * i;
    const float r = std::sqrt(std::max(0.0f, 1 - z * z));
    return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

TEST(LightFrame, HasTheGeneralFormulasCoordinates)
{
    int compared = 0;
    for (int i = 0; i < 200; ++i) {
        for (int j = 0; j < 200; ++j) {
            const vec3 l = direction(i, -0.3f), v = direction(7 * i + 1, 0.2f), n = direction(j, 0.05f);
            const LightFrame frame = lightFrame(l, v, vec3(1));
            const vec3 m = normalInFrame(frame, n);
            EXPECT_NEAR(cosineInFrame(frame, m), dot(n, l), 1e-6f);
            EXPECT_NEAR(length(lightDirection(frame) - l), 0, 1e-6f);
            if (dot(n, l) <= 0 || dot(n, v) <= 0) {
                continue;
            }
            for (const int coordinates : {kHalfDifference, kOneWay}) {
                const TableDomain domain{coordinates, 1.0f};
                const vec3 expected = unitFromDirections(domain, n, l, v), unit = unitInFrame(frame, m, domain);
                ++compared;
                EXPECT_NEAR(unit.x, expected.x, 2e-6f);
                EXPECT_NEAR(unit.y, expected.y, 2e-6f);
                // The azimuth about h is as uncertain as n x h is short.
                const float sine = length(cross(n, vec3(frame.half_)));
                EXPECT_NEAR(unit.z * sine, expected.z * sine, 2e-6f);
            }
        }
    }
    EXPECT_GT(compared, 20000);
}

TEST(LightFrame, LightBesideTheCameraHasNoPhiD)
{
    const vec3 v(0, 0, 1), n = direction(3, 0.3f);
    const LightFrame frame = lightFrame(v, v, vec3(1));
    for (const int coordinates : {kHalfDifference, kOneWay}) {
        const TableDomain domain{coordinates, kHalfPi};
        const vec3 unit = unitInFrame(frame, normalInFrame(frame, n), domain);
        EXPECT_EQ(unit.y, 0);
        EXPECT_EQ(unit.z, 0);
        EXPECT_NEAR(unit.x, unitFromDirections(domain, n, v, v).x, 1e-6f);
    }
}

TEST(LightFrame, QuadrantAtanIsAtan)
{
    for (int i = 0; i <= 2000; ++i) {
        const double angle = 1e-4 + (1.5707 - 1e-4) * i / 2000;
        const float found = quadrantAtan(static_cast<float>(std::sin(angle)), static_cast<float>(std::cos(angle)));
        EXPECT_NEAR(found, angle, 1.5e-6 * angle + 2e-7);
    }
    EXPECT_EQ(quadrantAtan(0, 1), 0);
    EXPECT_FLOAT_EQ(quadrantAtan(1, 0), kHalfPi);
}

TEST(Tone, FastCurveIsSrgbToATenthOfACode)
{
    for (int i = 0; i <= 20000; ++i) {
        const float x = static_cast<float>(i) / 20000;
        EXPECT_NEAR(fastSrgbFromLinear(x), srgbFromLinear(x), 0.11f / 255) << x;
    }
    EXPECT_EQ(fastSrgbFromLinear(0), 0);
    EXPECT_NEAR(fastSrgbFromLinear(7), 1, 0.11f / 255);
}

TEST(Tone, FilmicRisesAndNeverClipsEarly)
{
    float before = -1;
    for (int i = 0; i <= 100; ++i) {
        const float now = filmicFromLinear(0.05f * i);
        EXPECT_GE(now, before);
        before = now;
    }
    EXPECT_EQ(filmicFromLinear(0), 0);
    EXPECT_LT(filmicFromLinear(1.5f), 1);
}

TEST(Ball, PackedNormalsKeepTheWholeSphere)
{
    for (int i = 0; i < 500; ++i) {
        const vec3 n = direction(i, -0.99f);
        const vec2 packed = packedFromNormal(n);
        EXPECT_TRUE(isPackedNormal(packed));
        EXPECT_LE(std::max(std::abs(packed.x), std::abs(packed.y)), 1);
        EXPECT_NEAR(length(normalFromDisc(kPackedReach * packed) - n), 0, 3e-5f); // 1 + z loses digits behind
        EXPECT_EQ(dot(packed, packed) < 0.5f, n.z > 0);
    }
    EXPECT_FALSE(isPackedNormal(vec2(1, 1)));
}

TEST(Ball, ResizingKeepsThePlace)
{
    const vec3 n = direction(5, 0.1f);
    const vec2 there = resizedBallTexel(ballTexelFromNormal(n, 64), 64, 1024);
    EXPECT_NEAR(length(there - ballTexelFromNormal(n, 1024)), 0, 1e-6f);
}

} // namespace
} // namespace nacre
