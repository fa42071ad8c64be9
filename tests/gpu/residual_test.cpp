// A residual layer on the device: the same as its twin on the CPU in both paths, in bands, off and alone.
#include <glm/geometric.hpp>

#include "engine/files/measures.h"
#include "engine/gpu/renderer.h"
#include "engine/scene/reference.h"
#include "tests/gpu/frame_match.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/scenes.h"
#include "tests/support/expect_error.h"
#include "tests/support/residual_surface.h"

namespace nacre::test {
namespace {

// One material and no albedo factors.
Scene plainScene(int width = 96, int height = 64, int components = 6)
{
    Scene scene = glossyScene(width, height);
    scene.surface.lights = capturedRing(9);
    scene.surface.residual = anyResidual(scene.surface, components);
    scene.lights = capOfLights(3, 50);
    return scene;
}

// Two materials and pixels of none, albedo factors.
Scene modulatedScene(int width, int height, int components)
{
    Scene scene = plainScene(width, height, components);
    Surface& surface = scene.surface;
    surface.materials.push_back(materialOf(LambertGgx{.alpha = 0.4f}, {kHalfDifference, kHalfPi / 2}, {16, 16, 16}));
    surface.albedo = Image(width, height, 3);
    for (size_t i = 0; i < surface.labels.size(); ++i) {
        surface.labels[i] = i % 7 == 0 ? uint8_t{255} : static_cast<uint8_t>(i % 3 == 0);
        for (size_t c = 0; c < 3; ++c) {
            surface.albedo.values[3 * i + c] = 0.5f + 0.25f * static_cast<float>((i + c) % 5);
        }
    }
    return scene;
}

class ResidualTest : public GpuTest {};

TEST_F(ResidualTest, RadianceIsThatOfItsTwin)
{
    // A part of a texel of components, and more than one with a rest; the second so large that it is drawn in bands.
    const int wide = DirectFrame::kBandTexels / 512;
    for (const Scene& scene : {plainScene(96, 64, 3), plainScene(wide, 700, 9), modulatedScene(96, 64, 21)}) {
        Renderer renderer = rendererOf(scene, RenderPath::direct);
        EXPECT_TRUE(framesMatch(renderer.radiance(), renderReference(scene)));
    }
}

TEST_F(ResidualTest, BallPictureIsThatOfItsTwin)
{
    // Four pixels are drawn at once: rows that end within them and beyond, a row shorter than that; more rows than are
    // drawn at once. Components that fill texels, and that leave a rest.
    static_assert(FoursTarget::kBandPixels < 1023 * 301);
    for (const Scene& scene : {plainScene(), plainScene(3, 90, 16), modulatedScene(97, 63, 19),
                               modulatedScene(98, 41, 40), modulatedScene(95, 41, 64), plainScene(1023, 301, 5)}) {
        SCOPED_TRACE(testing::Message() << scene.surface.normals.width << ", " << scene.surface.residual.components);
        Renderer renderer = rendererOf(scene, RenderPath::ball);
        const Display display{.exposureStops = 1};
        renderer.setDisplay(display);
        const Image twin = referenceBallPicture(scene, renderer.ballSizes(), display);
        // Half floats of the ball and 16-bit normals: a code here and there.
        EXPECT_LE(codeDifference(renderer.picture(), twin, 1).share(), 0.002);
    }
}

TEST_F(ResidualTest, PathsShowTheSame)
{
    for (const Scene& scene : {plainScene(), modulatedScene(97, 64, 9)}) {
        Renderer ball = rendererOf(scene, RenderPath::ball), direct = rendererOf(scene, RenderPath::direct);
        EXPECT_LE(codeDifference(ball.picture(), direct.picture(), 4).share(), 0.01);
    }
}

TEST_F(ResidualTest, OffIsTheBrdfAndOnComesBack)
{
    for (Scene scene : {plainScene(), modulatedScene(97, 64, 9)}) {
        Renderer renderer = rendererOf(scene, RenderPath::automatic);
        const Image on = renderer.picture();
        renderer.setResidual(ResidualUse::off);
        const Image off = renderer.picture();
        renderer.setResidual(ResidualUse::on);
        EXPECT_EQ(renderer.picture().values, on.values);
        EXPECT_NE(off.values, on.values);
        scene.surface.residual = {};
        Renderer without = rendererOf(scene, RenderPath::automatic);
        EXPECT_EQ(off.values, without.picture().values);
    }
}

TEST_F(ResidualTest, AloneIsGreyWhereTheLayerHasNothing)
{
    Scene scene = plainScene();
    scene.surface.residual.weights.assign(scene.surface.residual.weights.size(), glm::vec3(0));
    for (const RenderPath path : {RenderPath::ball, RenderPath::direct}) {
        Renderer renderer = rendererOf(scene, path);
        renderer.setResidual(ResidualUse::alone);
        const Image picture = renderer.picture();
        const size_t middle = scene.surface.normals.index(48, 32);
        ASSERT_GT(scene.surface.normals.confidence[middle], 0);
        EXPECT_NEAR(picture.values[3 * middle], 0.5, 1.0 / 255);
    }
}

TEST_F(ResidualTest, MoreTexelsThanTheDeviceHasAreAnError)
{
    const VkDeviceSize texels = VkDeviceSize{context->limits().maxTexelBufferElements} + 1;
    expectError([&] { TexelBuffer(*context, kFloatFormat, 16 * texels, Memory::device); }, {"too large", "at most"});
}

TEST_F(ResidualTest, IsLeftOutOfOtherViews)
{
    Scene scene = plainScene();
    scene.view = glm::normalize(glm::vec3(0.2f, 0, 1));
    Renderer renderer(*context);
    EXPECT_TRUE(framesMatch(renderer.render(scene), renderReference(scene)));
}

} // namespace
} // namespace nacre::test
