// While lights move: pictures near to those at rest, for the cost of the lights that move; at rest the same bytes as
// ever.
#include <utility>

#include <glm/geometric.hpp>

#include "engine/brdf/brdf_tabulation.h"
#include "engine/files/measures.h"
#include "engine/gpu/renderer.h"
#include "shared/layout.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/scenes.h"

namespace nacre::test {
namespace {

void turnLight(Scene& scene, size_t light)
{
    scene.lights[light].direction = glm::normalize(scene.lights[light].direction + glm::vec3(0.05f, -0.1f, 0));
}

TEST(MovingLightsTest, KeepTheirsApartFromThoseThatStay)
{
    std::vector<Light> lights = capOfLights(6, 60);
    MovingLights moving;
    EXPECT_EQ(moving.follow(lights).moved, (LightRange{0, 6})) << "nothing is known of the first";
    lights[2].irradiance *= 2;
    const MovingLights::Order one = moving.follow(lights);
    EXPECT_EQ(one.still, (LightRange{0, 5}));
    EXPECT_EQ(one.moved, (LightRange{8, 9})) << "from a group of its own";
    EXPECT_EQ(one.lights[2], lights[3]);
    EXPECT_EQ(one.lights[8], lights[2]);
    lights[0].irradiance *= 2;
    EXPECT_EQ(moving.follow(lights).still, (LightRange{0, 4})) << "what has moved once may move again";
    lights.pop_back();
    EXPECT_EQ(moving.follow(lights).moved, (LightRange{0, 5}));
}

Material ggx(float alpha)
{
    const LambertGgx model{.diffuse = {0.4f, 0.2f, 0.05f}, .specular = glm::vec3(0.05f, 0.1f, 0.5f), .alpha = alpha};
    return {"ggx", tabulatedBrdf(model), {}};
}

class MovingLightsOnDeviceTest : public GpuTest {};

TEST_F(MovingLightsOnDeviceTest, ALightThatMovesCostsItself)
{
    Scene scene = glossyScene(120, 80);
    scene.lights = capOfLights(7, 60);
    Renderer renderer = rendererOf(scene, RenderPath::ball);
    renderer.setLightsMove(true);
    renderer.drawPicture();
    for (int step = 0; step < 3; ++step) {
        const size_t before = renderer.drawnBallLights();
        turnLight(scene, 4);
        renderer.setLights(scene.lights);
        renderer.drawPicture();
        EXPECT_EQ(renderer.drawnBallLights() - before, step == 0 ? 7u : 1u);
    }
}

TEST_F(MovingLightsOnDeviceTest, PicturesAreNearToThoseAtRestAndThenTheSame)
{
    for (const RenderPath path : {RenderPath::ball, RenderPath::direct}) {
        for (const Show show : {Show::picture, Show::coverage}) {
            Scene scene = glossyScene(120, 80);
            scene.surface.materials[0] = ggx(0.3f); // whose balls are small enough to move
            scene.lights = capOfLights(7, 60);
            Renderer renderer = rendererOf(scene, path);
            renderer.setShow(show);
            renderer.setLightsMove(true);
            for (const size_t moved : {size_t{1}, size_t{1}, size_t{6}}) {
                renderer.picture();
                turnLight(scene, moved);
                renderer.setLights(scene.lights);
            }
            const Image moving = renderer.picture();
            renderer.setLightsMove(false);
            Renderer fresh = rendererOf(scene, path);
            fresh.setShow(show);
            const Image rest = fresh.picture();
            EXPECT_EQ(renderer.picture().values, rest.values);
            // The sum's order is another: a code that lies between two may go to the other one.
            EXPECT_LE(codeDifference(moving, rest, 1).share(), 0);
        }
    }
}

TEST_F(MovingLightsOnDeviceTest, SharpHighlightsAreCoarseWhileLightsMove)
{
    Scene scene = glossyScene(120, 80);
    scene.surface.materials[0] = ggx(0.002f);
    Renderer renderer = rendererOf(scene, RenderPath::automatic);
    EXPECT_EQ(renderer.pathTaken(), RenderPath::direct);
    EXPECT_FALSE(renderer.isCoarse());
    const Image rest = renderer.picture();
    renderer.setLightsMove(true);
    EXPECT_EQ(renderer.pathTaken(), RenderPath::ball);
    EXPECT_TRUE(renderer.isCoarse());
    renderer.drawPicture();
    renderer.setLightsMove(false);
    EXPECT_EQ(renderer.picture().values, rest.values);
}

TEST_F(MovingLightsOnDeviceTest, WhatLiesBesideTheObjectIsBlackWhereverItWas)
{
    Scene scene = glossyScene(120, 80);
    const auto keepOnly = [&](Surface surface, int from, int end) { // columns
        for (size_t i = 0; i < surface.normals.confidence.size(); ++i) {
            const int x = static_cast<int>(i) % surface.normals.width;
            surface.normals.confidence[i] *= x >= from && x < end;
        }
        return surface;
    };
    for (const float scale : {0.0f, 0.6f, 2.0f}) {
        Renderer renderer = rendererOf(scene, RenderPath::ball);
        for (const auto& [from, end] : {std::pair(5, 40), std::pair(61, 90), std::pair(0, 120), std::pair(0, 0)}) {
            Scene part = scene;
            part.surface = keepOnly(scene.surface, from, end);
            Renderer fresh = rendererOf(part, RenderPath::ball);
            renderer.setPixels(part.surface);
            if (scale > 0) {
                const Zoom zoom = wholeZoom(120, 80, scale);
                fresh.setZoom(zoom);
                renderer.setZoom(zoom);
            }
            EXPECT_EQ(renderer.picture().values, fresh.picture().values) << from << " at " << scale;
            renderer.setShow(Show::normals);
            renderer.drawPicture();
            renderer.setShow(Show::picture);
            EXPECT_EQ(renderer.picture().values, fresh.picture().values) << from << " at " << scale;
        }
    }
}

} // namespace
} // namespace nacre::test
