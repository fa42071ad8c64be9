#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/scene/reference.h"
#include "engine/surface/surface.h"
#include "tests/support/expect_error.h"
#include "tests/support/residual_surface.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

TEST(LightPlane, IsContinuousAtTheRimAndEndsBehind)
{
    const glm::vec2 front = lightPlanePoint(glm::normalize(glm::vec3(1, 0, 1e-4f)));
    const glm::vec2 behind = lightPlanePoint(glm::normalize(glm::vec3(1, 0, -1e-4f)));
    EXPECT_NEAR(glm::length(front - behind), 0, 1e-6); // the rim, from both sides
    EXPECT_EQ(lightPlanePoint({0, 0, 1}), glm::vec2(0));
    EXPECT_NEAR(glm::length(lightPlanePoint({0, 0, -1})), 2, 1e-6);
}

TEST(LightHull, KeepsWhatIsInsideAndMovesTheRestToItsEdge)
{
    const std::vector<glm::vec2> square = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, 0}, {1, 1}};
    const LightHull hull(square);
    EXPECT_NEAR(hull.area(), 4, 1e-6);
    EXPECT_TRUE(hull.contains({0.3f, -0.9f}));
    EXPECT_EQ(hull.nearest({0.5f, 3}), glm::vec2(0.5f, 1));
    EXPECT_EQ(hull.nearest({2, 2}), glm::vec2(1, 1));
}

TEST(LightHull, OfALineOrAPointHasNoArea)
{
    const std::vector<glm::vec2> line = {{0, 0}, {0.5f, 0.5f}, {1, 1}}, point = {{0.2f, 0.1f}, {0.2f, 0.1f}};
    EXPECT_NEAR(LightHull(line).area(), 0, 1e-6);
    EXPECT_NEAR(glm::length(LightHull(line).nearest({1, 0}) - glm::vec2(0.5f)), 0, 1e-6);
    EXPECT_EQ(LightHull(point).nearest({1, 1}), point[0]);
}

TEST(ResidualLayer, AddsOverLights)
{
    const Surface surface = residualSurface();
    const Light a{glm::normalize(glm::vec3(0.2f, 0.1f, 1)), {1, 2, 0.5f}},
        b{glm::normalize(glm::vec3(-0.3f, 0, 1)), {2, 1, 1}};
    const auto weights = [&](std::vector<Light> lights) { return residualFrame(surface.residual, lights).weights; };
    const ResidualWeights both = weights({a, b}), first = weights({a}), second = weights({b});
    for (size_t pixel = 0; pixel < surface.labels.size(); ++pixel) {
        const glm::vec3 sum =
            residualOfPixel(surface.residual, first, pixel) + residualOfPixel(surface.residual, second, pixel);
        EXPECT_NEAR(glm::length(residualOfPixel(surface.residual, both, pixel) - sum), 0, 1e-5) << pixel;
    }
}

TEST(ResidualLayer, FadesOutWhereNoLightWasCaptured)
{
    const Surface surface = residualSurface();
    const ResidualLights lights(surface.residual);
    EXPECT_EQ(lights.at({0, 0, 1}).presence, 1);
    EXPECT_EQ(lights.at({0, 0, 1}).trust, surface.residual.trust);
    const ResidualLight behind = lights.at({0, 0, -1});
    EXPECT_EQ(behind.presence, 0);
    EXPECT_EQ(behind.trust, 1);
    float last = 1;
    for (float angle = 0; angle < 3.1f; angle += 0.05f) {
        const float presence = lights.at({std::sin(angle), 0, std::cos(angle)}).presence;
        EXPECT_LE(presence, last) << angle;
        last = presence;
    }
}

// One light, many equal ones, none, from anywhere: what is shown is finite and not negative.
TEST(ResidualLayer, IsBoundedUnderAnyLights)
{
    Surface surface = residualSurface();
    for (const glm::vec3& direction :
         {glm::vec3(0, 0, 1), glm::vec3(1, 0, 0), glm::vec3(0, 0, -1), glm::vec3(0, -1, 0)}) {
        for (const size_t count : {size_t{0}, size_t{1}, size_t{50}}) {
            const Frame frame =
                renderReference({surface, std::vector<Light>(count, Light{direction, {1, 1, 1}}), {0, 0, 1}});
            for (const float value : frame.values) {
                ASSERT_TRUE(std::isfinite(value) && value >= 0) << value;
                ASSERT_LE(value, 50 * 20); // codes 0..1 of weights of a few units
            }
        }
    }
}

TEST(ResidualLayer, IsForTheViewFromTheFrontAlone)
{
    Surface surface = residualSurface();
    const glm::vec3 aside = glm::normalize(glm::vec3(0.3f, 0, 1));
    const std::vector<Light> lights = {Light{}};
    const Frame with = renderReference({surface, lights, aside}), front = renderReference({surface, lights, {0, 0, 1}});
    surface.residual = {};
    EXPECT_EQ(with.values, renderReference({surface, lights, aside}).values);
    EXPECT_NE(front.values, renderReference({surface, lights, {0, 0, 1}}).values);
}

TEST(ResidualLayer, ComesBackFromItsFiles)
{
    const TempFolder folder;
    const Surface surface = residualSurface();
    saveSurface(folder / "s.nacre", surface, false);
    const ResidualLayer back = loadSurface(folder / "s.nacre").residual;
    EXPECT_EQ(back.codes, surface.residual.codes);
    EXPECT_EQ(back.weights, surface.residual.weights);
    EXPECT_EQ(back.low, surface.residual.low);
    EXPECT_EQ(back.high, surface.residual.high);
    EXPECT_EQ(back.trust, surface.residual.trust);
}

TEST(ResidualLayer, FilesThatDoNotFitAreDataErrors)
{
    const TempFolder folder;
    const auto damaged = folder / "s.nacre";
    saveSurface(damaged, residualSurface(), false);
    saveImage(damaged / "residual_01.png", Image(3, 3, 1), PixelType::uint8);
    expectError([&] { loadSurface(damaged); }, {"residual_01.png", "3x3"});
    saveSurface(damaged, residualSurface(), true);
    Image weights = loadImage(damaged / "residual_weights.exr");
    weights.values[4] = std::numeric_limits<float>::quiet_NaN();
    saveImage(damaged / "residual_weights.exr", weights, PixelType::float32);
    expectError([&] { loadSurface(damaged); }, {"residual_weights.exr", "no number"});
}

TEST(ResidualLayer, FollowsItsPixelsIntoAnotherSize)
{
    const Surface surface = residualSurface();
    const int twice = 2 * surface.normals.width;
    const Surface larger = fittedSurface(surface, twice, twice);
    const ResidualWeights weights = residualFrame(surface.residual, std::vector<Light>{Light{}}).weights;
    for (int y = 0; y < twice; ++y) {
        for (int x = 0; x < twice; ++x) {
            const size_t from = surface.normals.index(x / 2, y / 2), to = larger.normals.index(x, y);
            ASSERT_EQ(residualOfPixel(larger.residual, weights, to), residualOfPixel(surface.residual, weights, from));
        }
    }
}

} // namespace
} // namespace nacre
