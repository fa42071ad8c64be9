// Cast shadows on the device, against the twin on the CPU.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/files/error.h"
#include "engine/gpu/renderer.h"
#include "engine/scene/reference.h"
#include "tests/gpu/frame_match.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/scenes.h"

namespace nacre::test {
namespace {

using ShadowTest = GpuTest;

// Waves of slopes up to 1.5 with a hole and a second material, under lights as low as 15 degrees.
Scene wavyScene(int width, int height)
{
    Scene scene;
    Surface& surface = scene.surface;
    surface = transferredSurface(NormalMap(width, height), glossyMaterial());
    surface.materials.push_back(
        materialOf(LambertGgx{.diffuse = {0.1f, 0.5f, 0.3f}}, {kNatural, kHalfPi}, {16, 16, 8}));
    surface.height = Image(width, height, 1);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const size_t i = surface.normals.index(x, y);
            if (std::hypot(x - 0.4f * width, y - 0.6f * height) < 0.1f * height) {
                continue;
            }
            surface.height.values[i] = 6 * std::sin(0.25f * x) + 5 * std::cos(0.3f * y);
            surface.normals.normals[i] =
                glm::normalize(glm::vec3(-1.5f * std::cos(0.25f * x), -1.5f * std::sin(0.3f * y), 1));
            surface.normals.confidence[i] = 1;
            surface.labels[i] = x < width / 2 ? 0 : 1;
        }
    }
    scene.lights = capOfLights(6, 75);
    return scene;
}

Scene shadowed(Scene scene, int azimuths = kHorizonAzimuths)
{
    scene.surface.horizon = horizonMap(scene.surface.normals, scene.surface.height, azimuths);
    return scene;
}

TEST_F(ShadowTest, IsTheTwins)
{
    for (const int azimuths : {4, 16, kHorizonAzimuths}) {
        const Scene scene = shadowed(wavyScene(120, 90), azimuths);
        EXPECT_TRUE(framesMatch(Renderer(*context).render(scene), renderReference(scene))) << azimuths;
    }
    Scene plain = shadowed(wavyScene(120, 90));
    plain.surface.materials.pop_back();
    EXPECT_TRUE(framesMatch(Renderer(*context).render(plain), renderReference(plain))) << "one material";
}

// More pixels than one band of radiance holds.
TEST_F(ShadowTest, IsTheTwinsInBands)
{
    Scene scene = shadowed(wavyScene(1200, 900), 8);
    scene.lights = {{glm::normalize(glm::vec3(-0.8f, 0.3f, 0.5f)), {1, 1, 1}}};
    Renderer renderer(*context);
    const Frame expected = renderReference(scene);
    EXPECT_TRUE(framesMatch(renderer.render(scene), expected));
    renderer.setDisplay({.exposureStops = 0});
    const Image picture = renderer.picture(), wanted = displayedImage(expected, {.exposureStops = 0});
    size_t differing = 0;
    for (size_t i = 0; i < picture.values.size(); ++i) {
        differing += std::abs(picture.values[i] - wanted.values[i]) > 1.5f / 255;
    }
    // Packed normals move a highlight's flank by more than a code in few pixels.
    EXPECT_LT(differing, picture.values.size() / 1000);
}

TEST_F(ShadowTest, NeverBrightens)
{
    const Scene free = wavyScene(120, 90), dark = shadowed(free);
    const Frame without = Renderer(*context).render(free), with = Renderer(*context).render(dark);
    size_t darker = 0;
    for (size_t i = 0; i < with.values.size(); ++i) {
        ASSERT_TRUE(std::isfinite(with.values[i]));
        ASSERT_LE(with.values[i], without.values[i]);
        darker += with.values[i] < 0.9f * without.values[i];
    }
    EXPECT_GT(darker, with.values.size() / 10);
}

// A horizon that hides nothing is the picture without: to the byte.
TEST_F(ShadowTest, OfAPlaneIsThePictureWithout)
{
    Scene scene = wavyScene(64, 48);
    scene.surface.height.values.assign(scene.surface.height.values.size(), 0.0f);
    EXPECT_EQ(Renderer(*context).render(shadowed(scene)).values, Renderer(*context).render(scene).values);
}

TEST_F(ShadowTest, TakesTheDirectPathAndSaysWhy)
{
    Renderer renderer(*context);
    renderer.setSurface(wavyScene(64, 48).surface);
    renderer.setLights(capOfLights(2, 40));
    EXPECT_EQ(renderer.pathTaken(), RenderPath::ball);
    renderer.setSurface(shadowed(wavyScene(64, 48)).surface);
    EXPECT_EQ(renderer.pathTaken(), RenderPath::direct);
    EXPECT_NE(renderer.whyDirect().find("shadows"), std::string::npos);
    renderer.setPath(RenderPath::ball);
    EXPECT_THROW(renderer.pathTaken(), Error);
}

TEST_F(ShadowTest, IsCountedInMemoryAndLeavesWithTheSurface)
{
    const Scene free = wavyScene(128, 128);
    Renderer renderer(*context);
    const Frame before = renderer.render(free);
    const VkDeviceSize bytes = renderer.deviceBytes();
    renderer.render(shadowed(free));
    EXPECT_GE(renderer.deviceBytes(), bytes + 128 * 128 * kHorizonAzimuths);
    EXPECT_EQ(renderer.render(free).values, before.values);
    EXPECT_EQ(renderer.deviceBytes(), bytes);
}

// An even sample of the pixels sees its own horizons.
TEST_F(ShadowTest, ExposureIsThatOfTheShadowedPicture)
{
    Scene scene = shadowed(wavyScene(100, 80));
    Renderer renderer(*context);
    renderer.render(scene);
    EXPECT_FLOAT_EQ(renderer.automaticExposure(), automaticExposure(renderer.radiance()));
}

} // namespace
} // namespace nacre::test
