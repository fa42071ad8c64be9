#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/brdf/brdf_models.h"
#include "engine/scene/ball.h"
#include "engine/scene/ball_size.h"
#include "engine/scene/reference.h"

namespace nacre {
namespace {

BrdfTable glossyTable()
{
    BrdfTable table({64, 24, 16}, {kHalfDifference, 0.6f});
    const BrdfModel model = LambertGgx{{0.4f, 0.3f, 0.2f}, glm::vec3(0.04f), 0.3f};
    for (int k = 0; k < 16; ++k) {
        for (int j = 0; j < 24; ++j) {
            for (int i = 0; i < 64; ++i) {
                const LightView d = table.directions(i, j, k);
                table.values[table.index(i, j, k)] = evaluate(model, {0, 0, 1}, d.l, d.v);
            }
        }
    }
    return table;
}

// A ball is the same picture as the direct lookup of a sphere: with view and lights fixed the normal decides alone.
TEST(Ball, AnswersWhatTheDirectLookupOfASphereDoes)
{
    const std::vector<Light> lights = {{glm::normalize(glm::vec3(0.4f, 0.3f, 0.9f)), {1.0f, 0.8f, 0.6f}},
                                       {glm::normalize(glm::vec3(-0.5f, 0.2f, 0.8f)), {0.2f, 0.3f, 0.5f}}};
    const BrdfTable table = glossyTable();
    const Ball ball = makeBall(table, lights, 256);
    Scene scene{transferredSurface(sphereNormalMap(97), {"glossy", table, {}}), lights};
    const Frame direct = renderReference(scene);
    float peak = 0, worst = 0;
    for (int y = 0; y < 97; ++y) {
        for (int x = 0; x < 97; ++x) {
            const glm::vec3 n = scene.surface.normals.normals[scene.surface.normals.index(x, y)];
            // Towards the rim a texel spans ever more of the sphere.
            if (n.z > 0.3f) {
                peak = std::max(peak, direct.rgb(x, y).x);
                worst = std::max(worst, glm::length(sampleBall(ball, n) - direct.rgb(x, y)));
            }
        }
    }
    // 256 texels across an alpha of 0.3: bilinear filtering is off by less than 1 % of the peak.
    EXPECT_LT(worst, 0.01f * peak);
    EXPECT_GT(peak, 0.1f);
}

// Where a light sets, radiance has a crease, and the display shows darkness finely: a ball of radiance blurs it, one of
// the mean of f does not. The measured side is the least that no picture tells from the table's.
TEST(Ball, OfTheMeanKeepsTheCreaseWhereALightSets)
{
    const BrdfTable table = glossyTable();
    const int side = measuredMeanBallSide(table);
    ASSERT_GT(side, 0);
    ASSERT_LE(side, 128);
    const std::vector<Light> lights = {{glm::normalize(glm::vec3(0.9f, 0.3f, -0.1f)), glm::vec3(4)},
                                       {glm::normalize(glm::vec3(-0.8f, 0.5f, 0.3f)), {0, 0, 1}}};
    const Ball mean = makeMeanBall(table, lights, side), radiance = makeBall(table, lights, side);
    const NormalMap sphere = sphereNormalMap(97);
    size_t off = 0, offByRadiance = 0; // pixels, by more than a code and the other picture's rounding
    for (size_t i = 0; i < sphere.normals.size(); ++i) {
        const glm::vec3 n = sphere.normals[i];
        if (sphere.confidence[i] > 0 && n.z > 0.1f) { // at the rim f itself is steep
            const glm::vec3 truth = radianceUnder(lights, n, [&](const glm::vec3& l) {
                return evaluateTable(table, n, l, {0, 0, 1}).value;
            });
            const auto isOff = [&](const glm::vec3& found) {
                return std::max({std::abs(srgbFromLinear(found.x) - srgbFromLinear(truth.x)),
                                 std::abs(srgbFromLinear(found.y) - srgbFromLinear(truth.y)),
                                 std::abs(srgbFromLinear(found.z) - srgbFromLinear(truth.z))}) > 1.5f / 255;
            };
            off += isOff(sampleMeanBall(mean, lights, n));
            offByRadiance += isOff(sampleBall(radiance, n));
        }
    }
    EXPECT_EQ(off, 0u);
    EXPECT_GT(offByRadiance, 30u);
}

TEST(Ball, SameBytesForOneAndTwoThreads)
{
    const std::vector<Light> lights = {{{0, 0.6f, 0.8f}}};
    const BrdfTable table = glossyTable();
    EXPECT_EQ(makeBall(table, lights, 32, 1).radiance.values, makeBall(table, lights, 32, 2).radiance.values);
}

} // namespace
} // namespace nacre
