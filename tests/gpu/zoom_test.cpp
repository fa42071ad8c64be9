// Pictures at another scale against their twins on the CPU, and against the picture as it is.
#include "engine/brdf/brdf_tabulation.h"
#include "engine/files/measures.h"
#include "engine/gpu/renderer.h"
#include "engine/scene/reference.h"
#include "tests/gpu/frame_match.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/scenes.h"

namespace nacre::test {
namespace {

class ZoomTest : public GpuTest {
protected:
    // 16-bit normals may turn the last pixel of a rim.
    static void expectNear(const Image& picture, const Image& expected)
    {
        ASSERT_EQ(picture.values.size(), expected.values.size());
        size_t off = 0;
        for (size_t i = 0; i < picture.values.size(); ++i) {
            off += std::abs(picture.values[i] - expected.values[i]) > 1.01f / 255;
        }
        EXPECT_LE(off, picture.values.size() / 500);
    }

    Scene scene_ = glossyScene(90, 60);
};

TEST_F(ZoomTest, MagnifiedIsTheTwinsPicture)
{
    const Zoom zoom{.scale = 3.5f, .origin = {4.25f, 3}, .size = {200, 150}};
    const MagnifiedSurface near = magnified(scene_.surface, zoom);
    Scene nearScene = scene_;
    nearScene.surface = near.pixels;
    nearScene.surface.materials = scene_.surface.materials;
    const Frame radiance = renderReference(nearScene);
    Renderer renderer = rendererOf(scene_, RenderPath::direct);
    renderer.setZoom(zoom);
    expectNear(renderer.picture(), coveredCodes(displayedImage(radiance, {}), near.cover));
    EXPECT_TRUE(framesMatch(renderer.radiance(), coveredRadiance(radiance, near.cover)));
    Renderer fromBalls = rendererOf(scene_, RenderPath::ball);
    fromBalls.setZoom(zoom);
    expectNear(fromBalls.picture(),
               coveredCodes(referenceBallPicture(nearScene, fromBalls.drawnBallSizes(), {}), near.cover));
}

// Their texels are several pixels wide at the size that is fine enough for the picture as it is.
TEST_F(ZoomTest, MagnifiedIsFromFinerBalls)
{
    Scene sphere = glossyScene(90, 60);
    const BrdfTable gloss = tabulatedBrdf(LambertGgx{.diffuse = glm::vec3(0.4f), .alpha = 0.3f});
    sphere.surface = transferredSurface(sphereNormalMap(200), {"gloss", gloss, {}});
    const Zoom zoom{.scale = 4, .origin = {60, 60}, .size = {320, 320}};
    Renderer direct = rendererOf(sphere, RenderPath::direct), balls = rendererOf(sphere, RenderPath::ball);
    direct.setZoom(zoom);
    balls.setZoom(zoom);
    Scene near = sphere;
    near.surface = magnified(sphere.surface, zoom).pixels;
    near.surface.materials = sphere.surface.materials;
    const std::vector<uint8_t> all(320 * 320, 1);
    const auto off = [&](const Image& picture) { return picturePsnr(picture, direct.picture(), all); };
    EXPECT_GT(off(balls.picture()), off(referenceBallPicture(near, balls.ballSizes(), {})) + 2);
}

TEST_F(ZoomTest, ReducedIsTheMeanOfThePicture)
{
    const Zoom zoom{.scale = 0.4f, .origin = {2, 1.5f}, .size = {30, 20}};
    for (const RenderPath path : {RenderPath::direct, RenderPath::ball}) {
        Renderer renderer = rendererOf(scene_, path);
        const Image picture = renderer.picture();
        renderer.setZoom(zoom);
        expectNear(renderer.picture(), reducedCodes(picture, zoom));
    }
}

TEST_F(ZoomTest, ThePictureIsTheSameBeforeAndAfter)
{
    Renderer renderer = rendererOf(scene_, RenderPath::automatic);
    const Image before = renderer.picture();
    const float stops = renderer.automaticExposure();
    for (const float scale : {2.0f, 0.5f}) {
        renderer.setZoom(wholeZoom(90, 60, scale));
        const Image zoomed = renderer.picture();
        EXPECT_EQ(renderer.automaticExposure(), stops);
        renderer.setLights({});
        renderer.setLights(scene_.lights);
        EXPECT_EQ(renderer.picture().values, zoomed.values);
        renderer.setZoom({});
        EXPECT_EQ(renderer.picture().values, before.values);
    }
}

} // namespace
} // namespace nacre::test
