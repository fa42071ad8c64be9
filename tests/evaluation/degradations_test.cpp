#include "evaluation/stress/degradations.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "engine/files/measures.h"
#include "evaluation/stress/light_layouts.h"

namespace nacre {
namespace {

// Different values everywhere, evenly from 0 to 1, in an order that no degradation can know.
PhotographedObject scatteredObject(size_t pixels, size_t lights)
{
    PhotographedObject object;
    object.lights = spreadLights(lights, 55);
    object.photographs.resize(lights, "photograph");
    object.seen.lightCount = lights;
    for (size_t p = 0; p < pixels; ++p) {
        object.seen.pixels.push_back(static_cast<uint32_t>(3 * p));
    }
    const size_t count = pixels * lights;
    for (size_t k = 0; k < count; ++k) {
        const float value = static_cast<float>(k * 7919 % count) / static_cast<float>(count - 1);
        object.seen.radiance.push_back(glm::vec3(value, 0.5f * value, value));
    }
    object.seen.saturated.assign(count, 0);
    object.truth = NormalMap(static_cast<int>(pixels), 1);
    return object;
}

TEST(Degradations, AsTheyStandDoNothing)
{
    const PhotographedObject object = scatteredObject(50, 9);
    const PhotographedObject same = degraded(object, {});
    EXPECT_EQ(same.seen.radiance, object.seen.radiance);
    EXPECT_EQ(same.seen.saturated, object.seen.saturated);
    for (size_t i = 0; i < 9; ++i) {
        EXPECT_EQ(same.lights[i].direction, object.lights[i].direction);
        EXPECT_EQ(same.lights[i].irradiance, object.lights[i].irradiance);
    }
}

TEST(Degradations, NoiseHasItsDeviationAndNoMean)
{
    const PhotographedObject object = scatteredObject(500, 20);
    Observations noisy = object.seen;
    addNoise(noisy, 0.05, 3);
    double sum = 0, squares = 0;
    for (size_t k = 0; k < noisy.radiance.size(); ++k) {
        for (int c = 0; c < 3; ++c) {
            const double d = noisy.radiance[k][c] - object.seen.radiance[k][c];
            sum += d;
            squares += d * d;
        }
    }
    const double n = 3.0 * static_cast<double>(noisy.radiance.size());
    const double expected = 0.05 * valueQuantile(object.seen, 0.99);
    // Four standard errors of 30000 draws: 2.3 % of the deviation for the mean, 1.6 % for the deviation itself.
    EXPECT_NEAR(sum / n, 0, 0.023 * expected);
    EXPECT_NEAR(std::sqrt(squares / n), expected, 0.017 * expected);
}

TEST(Degradations, OverexposureCutsAndMarksItsShare)
{
    const PhotographedObject object = scatteredObject(300, 20);
    Observations cut = object.seen;
    overexpose(cut, 0.15);
    const float fullScale = valueQuantile(object.seen, 0.85);
    size_t values = 0;
    for (size_t k = 0; k < cut.radiance.size(); ++k) {
        bool clipped = false;
        for (int c = 0; c < 3; ++c) {
            const float before = object.seen.radiance[k][c];
            EXPECT_EQ(cut.radiance[k][c], std::min(before, fullScale));
            clipped |= before > fullScale;
            values += before > fullScale;
        }
        EXPECT_EQ(cut.saturated[k] != 0, clipped);
    }
    EXPECT_NEAR(static_cast<double>(values) / (3.0 * static_cast<double>(cut.radiance.size())), 0.15, 1e-3);
    Observations none = object.seen;
    overexpose(none, 0);
    EXPECT_EQ(none.radiance, object.seen.radiance);
}

TEST(Degradations, QuantisationLeavesSoManyLevelsAndMovesByHalfAStep)
{
    Observations seen = scatteredObject(300, 20).seen;
    seen.radiance.front() = glm::vec3(-0.1f);
    const Observations before = seen;
    quantise(seen, 4);
    std::set<float> levels;
    for (size_t k = 0; k < seen.radiance.size(); ++k) {
        levels.insert(seen.radiance[k].x);
        EXPECT_LE(std::abs(seen.radiance[k].x - std::max(before.radiance[k].x, 0.0f)), 0.5f / 15 + 1e-6f);
    }
    EXPECT_EQ(levels.size(), 16u);
    EXPECT_EQ(*levels.begin(), 0.0f);
}

TEST(Degradations, DirectionsTurnByJustTheAngleAndNotAlike)
{
    std::vector<Light> lights = spreadLights(40, 60);
    const std::vector<Light> before = lights;
    turnDirections(lights, 5, 1);
    glm::vec3 sum(0);
    for (size_t i = 0; i < lights.size(); ++i) {
        EXPECT_NEAR(degreesBetween(lights[i].direction, before[i].direction), 5, 1e-4);
        sum += lights[i].direction - before[i].direction;
    }
    // Forty steps of 0.087 to all sides: all to one side would make 3.5.
    EXPECT_LT(glm::length(sum), 1.5f);
}

TEST(Degradations, IrradiancesMoveByTheirDeviationAndKeepTheirColour)
{
    std::vector<Light> lights = spreadLights(2000, 60);
    misjudgeIrradiances(lights, 0.1, 1);
    double squares = 0;
    for (const Light& light : lights) {
        EXPECT_EQ(light.irradiance.x, light.irradiance.y);
        squares += std::pow(std::log(light.irradiance.x), 2);
    }
    // Four standard errors of 2000 draws are 6 % of the deviation.
    EXPECT_NEAR(std::sqrt(squares / 2000), 0.1, 0.0065);
}

TEST(Degradations, ShadowsBlockLightsThatStandSideBySide)
{
    PhotographedObject object = scatteredObject(200, 30);
    for (glm::vec3& radiance : object.seen.radiance) {
        radiance += glm::vec3(1); // none is 0 before
    }
    castShadows(object.seen, object.lights, 0.2, 5);
    std::set<size_t> middles;
    for (size_t p = 0; p < 200; ++p) {
        std::vector<size_t> blocked, open;
        for (size_t i = 0; i < 30; ++i) {
            (object.seen.radianceOf(p)[i] == glm::vec3(0) ? blocked : open).push_back(i);
        }
        ASSERT_EQ(blocked.size(), 6u);
        // Of one of those blocked, all others are nearer than any that is open.
        const bool sideBySide = std::any_of(blocked.begin(), blocked.end(), [&](size_t middle) {
            const auto angleTo = [&](size_t i) {
                return degreesBetween(object.lights[i].direction, object.lights[middle].direction);
            };
            double furthest = 0, nearest = 180;
            for (const size_t i : blocked) {
                furthest = std::max(furthest, angleTo(i));
            }
            for (const size_t i : open) {
                nearest = std::min(nearest, angleTo(i));
            }
            return furthest <= nearest + 1e-4;
        });
        EXPECT_TRUE(sideBySide) << p;
        middles.insert(blocked.front());
    }
    EXPECT_GT(middles.size(), 5u) << "every pixel has its own";
}

TEST(Degradations, NearLightsFallWithTheSquareOfTheDistance)
{
    PhotographedObject object;
    object.width = 5;
    object.height = 1;
    object.lights.resize(1);
    object.lights[0].direction = {0, 0, 1};
    object.truth = NormalMap(3, 1);
    for (const uint32_t pixel : {0u, 2u, 4u}) {
        object.seen.pixels.push_back(pixel);
        object.seen.radiance.emplace_back(1);
        object.seen.saturated.push_back(0);
        object.truth.normals[pixel / 2] = {0, 0, 1};
    }
    object.seen.lightCount = 1;
    bringLightsNear(object, 2);
    EXPECT_NEAR(object.seen.radiance[1].x, 1, 1e-6) << "the middle";
    // Half a width beside the middle, two widths away: the cube of the cosine, two of the distance and one of n.l.
    const float cosine = 2 / std::sqrt(4.25f);
    EXPECT_NEAR(object.seen.radiance[0].x, cosine * cosine * cosine, 1e-6);
    EXPECT_NEAR(object.seen.radiance[2].x, cosine * cosine * cosine, 1e-6);
}

TEST(Degradations, TransferCurvesBendAndKeepTheEnds)
{
    Observations seen = scatteredObject(100, 5).seen;
    const Observations before = seen;
    const float fullScale = valueQuantile(seen, 1);
    bendTransfer(seen, 2);
    for (size_t k = 0; k < seen.radiance.size(); ++k) {
        EXPECT_NEAR(seen.radiance[k].x, std::sqrt(before.radiance[k].x / fullScale) * fullScale, 1e-5);
    }
}

TEST(Degradations, AMisplacedSphereTurnsAllLightsAlike)
{
    std::vector<Light> lights = spreadLights(30, 40);
    const std::vector<Light> before = lights;
    misplaceSphere(lights, 0.02);
    for (size_t i = 0; i < lights.size(); ++i) {
        const glm::vec3 moved = lights[i].direction - before[i].direction;
        EXPECT_LT(moved.x, 0);
        EXPECT_LT(moved.y, 0);
        // Twice the shift of the highlight's normal, over its cosine: 2.3 degrees in the middle, at 40 degrees 2.15
        // to 2.6.
        const double degrees = degreesBetween(lights[i].direction, before[i].direction);
        EXPECT_GT(degrees, 2.15);
        EXPECT_LT(degrees, 2.7);
    }
}

TEST(Degradations, FlippedLightsPointDownwards)
{
    std::vector<Light> lights = spreadLights(4, 40);
    const glm::vec3 before = lights[2].direction;
    flipUpwards(lights);
    EXPECT_EQ(lights[2].direction, glm::vec3(before.x, -before.y, before.z));
}

TEST(Degradations, AreTheSameForTheSameSeedAlone)
{
    const PhotographedObject object = scatteredObject(50, 12);
    Degradation degradation;
    degradation.noise = 0.02;
    degradation.directionErrorDegrees = 1;
    degradation.irradianceError = 0.1;
    const PhotographedObject a = degraded(object, degradation), b = degraded(object, degradation);
    EXPECT_EQ(a.seen.radiance, b.seen.radiance);
    EXPECT_EQ(a.lights[3].direction, b.lights[3].direction);
    degradation.seed = 2;
    const PhotographedObject other = degraded(object, degradation);
    EXPECT_NE(a.seen.radiance, other.seen.radiance);
    EXPECT_NE(a.lights[3].direction, other.lights[3].direction);
    EXPECT_NE(a.lights[3].irradiance, other.lights[3].irradiance);
}

TEST(Degradations, SelectionKeepsWhatBelongsTogether)
{
    const PhotographedObject object = scatteredObject(20, 10);
    const PhotographedObject few = selectPhotographs(object, {2, 5, 9});
    ASSERT_EQ(few.lights.size(), 3u);
    for (size_t p = 0; p < 20; ++p) {
        EXPECT_EQ(few.seen.radianceOf(p)[1], object.seen.radianceOf(p)[5]);
    }
    EXPECT_EQ(few.lights[2].direction, object.lights[9].direction);
}

} // namespace
} // namespace nacre
