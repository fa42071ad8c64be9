// The ball path: near to the direct one, the same as its twin on the CPU, and without a memory of what was drawn
// before.
#include <cstdio>

#include <glm/geometric.hpp>

#include "engine/brdf/brdf_tabulation.h"
#include "engine/files/error.h"
#include "engine/files/measures.h"
#include "engine/gpu/renderer.h"
#include "engine/scene/reference.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/scenes.h"

namespace nacre::test {
namespace {

struct PictureDifference {
    double psnr = 0;         // dB
    double visibleShare = 0; // of pixels off by more than 4/255
    double anyShare = 0;     // off by more than 1/255
};

PictureDifference difference(const Image& a, const Image& b)
{
    const std::vector<uint8_t> all(a.pixelCount(), 1);
    return {picturePsnr(a, b, all), codeDifference(a, b, 4).share(), codeDifference(a, b, 1).share()};
}

Scene ggxScene(float alpha, int width = 300, int height = 200)
{
    const LambertGgx model{.diffuse = {0.4f, 0.2f, 0.05f}, .specular = glm::vec3(0.05f, 0.1f, 0.5f), .alpha = alpha};
    Scene scene;
    scene.surface = transferredSurface(bumpyNormals(width, height), {"ggx", tabulatedBrdf(model), {}});
    scene.lights = capOfLights(4, 60);
    return scene;
}

Scene twoMaterialScene()
{
    Scene scene = ggxScene(0.3f);
    scene.surface.materials.push_back(ggxScene(0.1f, 4, 4).surface.materials[0]);
    scene.surface.albedo = Image(300, 200, 3);
    for (size_t i = 0; i < scene.surface.labels.size(); ++i) {
        const size_t stripe = i / 11 % 4;
        scene.surface.labels[i] = stripe == 2 ? Surface::kNoMaterial : static_cast<uint8_t>(stripe % 2);
        for (size_t c = 0; c < 3; ++c) {
            scene.surface.albedo.values[3 * i + c] = 0.2f + 0.01f * static_cast<float>((i + 31 * c) % 170);
        }
    }
    return scene;
}

class BallPathTest : public GpuTest {};

TEST_F(BallPathTest, IsAsGoodAsDirect)
{
    for (const float alpha : {0.05f, 0.1f, 0.3f}) {
        SCOPED_TRACE(alpha);
        const Scene scene = ggxScene(alpha);
        Renderer ball = rendererOf(scene, RenderPath::automatic), direct = rendererOf(scene, RenderPath::direct);
        const Display display{.exposureStops = automaticExposure(direct.radiance())};
        ball.setDisplay(display);
        direct.setDisplay(display);
        EXPECT_EQ(ball.pathTaken(), RenderPath::ball);
        const PictureDifference found = difference(ball.picture(), direct.picture());
        EXPECT_GE(found.psnr, kLeastPsnr);
        EXPECT_LE(found.visibleShare, kLargestShare);
        const BallSize size = ball.ballSizes()[0];
        std::printf("  alpha %.2f: ball %d, shown at %d: %.1f dB, %.3f %% off by more than 4/255\n", alpha,
                    size.radiance, size.display, found.psnr, 100 * found.visibleShare);
    }
}

// 16-bit normals may choose the neighbour of the CPU's nearest texel, which sharp highlights show.
TEST_F(BallPathTest, IsItsTwinOnTheCpu)
{
    for (const Scene& scene : {ggxScene(0.3f), ggxScene(0.08f), twoMaterialScene()}) {
        for (const int curve : {kToneSrgb, kToneFilmic}) {
            Renderer renderer = rendererOf(scene, RenderPath::ball);
            const Display display{.exposureStops = automaticExposure(renderer.radiance()), .toneCurve = curve};
            renderer.setDisplay(display);
            const Image twin = referenceBallPicture(scene, renderer.ballSizes(), display);
            const PictureDifference found = difference(renderer.picture(), twin);
            EXPECT_GE(found.psnr, 55);
            EXPECT_LE(found.anyShare, 0.005);
        }
    }
}

// Four pixels are drawn at a time, in bands of rows: rows that end within four, rows shorter than that, a last band
// lower than the others. alpha 0.3 has no texels so unlike their neighbours as to show which of them was nearest.
TEST_F(BallPathTest, PicturesOfAnySizeAreTheirTwins)
{
    static_assert(2 * FoursTarget::kBandPixels < 1023 * 701);
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {2, 70}, {3, 50}, {5, 41}, {98, 63}, {1023, 701}}) {
        for (const bool modulated : {false, true}) {
            SCOPED_TRACE(testing::Message() << size.x << "x" << size.y << (modulated ? ", modulated" : ""));
            Scene scene = ggxScene(0.3f, size.x, size.y);
            if (modulated) {
                scene.surface.albedo = Image(size.x, size.y, 3, 0.7f);
            }
            Renderer renderer = rendererOf(scene, RenderPath::ball);
            const Image twin = referenceBallPicture(scene, renderer.ballSizes(), Display{});
            EXPECT_LE(difference(renderer.picture(), twin).anyShare, 0.005);
        }
    }
}

// Pictures of the direct path read 16-bit normals and albedo factors: within a code of the exact ones, but at the
// terminator, where sRGB's curve is 13 times as steep.
TEST_F(BallPathTest, DirectPicturesAreTheReferences)
{
    for (const Scene& scene : {ggxScene(0.3f), twoMaterialScene()}) {
        for (const int curve : {kToneSrgb, kToneFilmic}) {
            Renderer renderer = rendererOf(scene, RenderPath::direct);
            const Display display{.exposureStops = automaticExposure(renderer.radiance()), .toneCurve = curve};
            renderer.setDisplay(display);
            const PictureDifference found =
                difference(renderer.picture(), displayedImage(renderReference(scene), display));
            EXPECT_GE(found.psnr, 58);
            EXPECT_LE(found.anyShare, 0.001);
        }
    }
}

TEST_F(BallPathTest, ADraggedSceneIsAFreshOne)
{
    Scene scene = twoMaterialScene();
    scene.lights = capOfLights(3 * BallCache::kLightsPerChunk + 5, 70);
    Renderer dragged = rendererOf(scene, RenderPath::ball);
    dragged.picture();
    for (const size_t moved : {size_t{7}, size_t{40}, scene.lights.size() - 1}) {
        scene.lights[moved].direction = glm::normalize(scene.lights[moved].direction + glm::vec3(0.1f, -0.2f, 0));
        dragged.setLights(scene.lights);
        dragged.setDisplay({.exposureStops = 0.5f});
        const Image before = dragged.picture();
        Renderer fresh = rendererOf(scene, RenderPath::ball);
        fresh.setDisplay({.exposureStops = 0.5f});
        EXPECT_EQ(before.values, fresh.picture().values);
        Renderer uncached =
            rendererOf(scene, RenderPath::ball, BallCache::leastBytes(dragged.ballSizes(), true, scene.lights.size()));
        uncached.setDisplay({.exposureStops = 0.5f});
        EXPECT_EQ(before.values, uncached.picture().values) << "without chunks in the cache";
    }
    for (const size_t count : {size_t{20}, size_t{16}, size_t{3}, size_t{0}, size_t{50}}) {
        SCOPED_TRACE(count);
        scene.lights = capOfLights(static_cast<int>(count), 60);
        dragged.setLights(scene.lights);
        Renderer fresh = rendererOf(scene, RenderPath::ball);
        fresh.setDisplay({.exposureStops = 0.5f});
        EXPECT_EQ(dragged.picture().values, fresh.picture().values);
    }
}

TEST_F(BallPathTest, AMovedLightCostsItsChunk)
{
    Scene scene = ggxScene(0.3f);
    scene.lights = capOfLights(4 * BallCache::kLightsPerChunk, 60);
    Renderer renderer = rendererOf(scene, RenderPath::ball);
    renderer.drawPicture();
    EXPECT_EQ(renderer.drawnBallLights(), scene.lights.size());
    scene.lights[20].irradiance *= 2;
    renderer.setLights(scene.lights);
    renderer.drawPicture();
    EXPECT_EQ(renderer.drawnBallLights(), scene.lights.size() + BallCache::kLightsPerChunk);
    renderer.setDisplay({.exposureStops = 1});
    renderer.drawPicture();
    EXPECT_EQ(renderer.drawnBallLights(), scene.lights.size() + BallCache::kLightsPerChunk)
        << "exposure needs no light";
}

TEST_F(BallPathTest, AStillPictureIsNotDrawnAgain)
{
    const Scene scene = ggxScene(0.3f);
    Renderer renderer = rendererOf(scene, RenderPath::automatic);
    const Image first = renderer.picture();
    renderer.setLights(scene.lights);
    renderer.setDisplay({});
    renderer.setView({0, 0, 1});
    EXPECT_EQ(renderer.picture().values, first.values);
    EXPECT_EQ(renderer.drawnPictures(), 1u);
    renderer.setDisplay({.exposureStops = 1});
    EXPECT_NE(renderer.picture().values, first.values);
    EXPECT_EQ(renderer.drawnPictures(), 2u);
}

TEST_F(BallPathTest, TheCacheIsBounded)
{
    Scene scene = ggxScene(0.3f);
    scene.lights = capOfLights(10000, 60);
    const VkDeviceSize bound = 4 << 20;
    Renderer renderer = rendererOf(scene, RenderPath::ball, bound);
    renderer.drawPicture();
    EXPECT_LE(renderer.cachedBytes(), bound);
    EXPECT_GT(renderer.cachedBytes(), 0u);
}

TEST_F(BallPathTest, OtherViewsAndMirrorsAreDirect)
{
    Scene scene = ggxScene(0.3f);
    scene.view = glm::normalize(glm::vec3(0.3f, 0, 1));
    EXPECT_EQ(rendererOf(scene, RenderPath::automatic).pathTaken(), RenderPath::direct);
    EXPECT_THROW(rendererOf(scene, RenderPath::ball).picture(), Error);
    const Scene mirror = ggxScene(0.002f);
    Renderer renderer = rendererOf(mirror, RenderPath::automatic);
    EXPECT_EQ(renderer.pathTaken(), RenderPath::direct) << renderer.ballSizes()[0].radiance;
    EXPECT_NE(renderer.whyDirect().find("too sharp"), std::string::npos) << renderer.whyDirect();
}

TEST_F(BallPathTest, FourMaterialsAt4kFitIntoTheMemory)
{
    Scene scene = ggxScene(0.1f, 3840, 2160);
    for (int i = 0; i < 3; ++i) {
        scene.surface.materials.push_back(scene.surface.materials[0]);
    }
    scene.lights = capOfLights(16, 60);
    Renderer renderer = rendererOf(scene, RenderPath::automatic);
    renderer.drawPicture();
    EXPECT_EQ(renderer.pathTaken(), RenderPath::ball);
    EXPECT_LE(renderer.deviceBytes(), VkDeviceSize{256} << 20);
    std::printf("  %llu MiB on the device\n", static_cast<unsigned long long>(renderer.deviceBytes() >> 20));
}

TEST_F(BallPathTest, TheBallOfAMaterialIsAPictureOfASphere)
{
    constexpr int kSide = 60;
    for (const Scene& scene : {ggxScene(0.3f), twoMaterialScene()}) {
        Renderer renderer = rendererOf(scene, RenderPath::automatic);
        for (size_t material = 0; material < scene.surface.materials.size(); ++material) {
            for (const float stops : {0.0f, 1.5f}) {
                renderer.setDisplay({.exposureStops = stops});
                Scene sphere = scene;
                sphere.surface = transferredSurface(sphereNormalMap(kSide), scene.surface.materials[material]);
                Renderer alone = rendererOf(sphere, RenderPath::ball);
                alone.setDisplay({.exposureStops = stops});
                const Texture* ball = renderer.drawMaterialBall(material, kSide);
                ASSERT_NE(ball, nullptr);
                // Balls of several materials hold halves of radiance, a part in 2048, which exposure brightens.
                EXPECT_EQ(codeDifference(readCodes(*context, *ball), alone.picture(), 2).share(), 0);
            }
        }
        renderer.setPath(RenderPath::direct);
        EXPECT_EQ(renderer.drawMaterialBall(0, kSide), nullptr);
    }
}

TEST_F(BallPathTest, LabelsWithoutAMaterialAreBlack)
{
    Scene scene = twoMaterialScene();
    scene.surface.labels.assign(scene.surface.labels.size(), 77);
    for (const RenderPath path : {RenderPath::ball, RenderPath::direct}) {
        for (const float value : rendererOf(scene, path).picture().values) {
            ASSERT_EQ(value, 0);
        }
    }
}

} // namespace
} // namespace nacre::test
