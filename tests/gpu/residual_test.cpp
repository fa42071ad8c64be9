// A residual layer on the device: the same as its twin on the CPU in both paths, in bands, off and alone.
#include <glm/geometric.hpp>

#include "engine/gpu/renderer.h"
#include "engine/scene/code_difference.h"
#include "engine/scene/reference.h"
#include "tests/gpu/frame_match.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/scenes.h"
#include "tests/support/residual_surface.h"

namespace nacre::test {
namespace {

Scene residualScene(int width = 96, int height = 64, int components = 6)
{
    Scene scene = glossyScene(width, height);
    scene.surface.lights = ringOfLights(9);
    scene.surface.residual = anyResidual(scene.surface, components);
    scene.lights = capOfLights(3, 50);
    return scene;
}

class ResidualTest : public GpuTest {
protected:
    static Renderer rendererOf(const Scene& scene, RenderPath path)
    {
        Renderer renderer(*context);
        renderer.setSurface(scene.surface);
        renderer.setLights(scene.lights);
        renderer.setPath(path);
        return renderer;
    }
};

TEST_F(ResidualTest, RadianceIsThatOfItsTwin)
{
    // One texel of components, and more than one with a rest; the second so large that it is drawn in bands.
    const int wide = DirectFrame::kBandTexels / 512;
    for (const Scene& scene : {residualScene(96, 64, 3), residualScene(wide, 700, 9)}) {
        Renderer renderer = rendererOf(scene, RenderPath::direct);
        EXPECT_TRUE(framesMatch(renderer.radiance(), renderReference(scene)));
    }
}

TEST_F(ResidualTest, BallPictureIsThatOfItsTwin)
{
    const Scene scene = residualScene();
    Renderer renderer = rendererOf(scene, RenderPath::ball);
    const Display display{.exposureStops = 1};
    renderer.setDisplay(display);
    const Image twin = referenceBallPicture(scene, renderer.ballSizes(), display);
    // Half floats of the ball and 16-bit normals: a code here and there.
    EXPECT_LE(codeDifference(renderer.picture(), twin, 1).share(), 0.002);
}

TEST_F(ResidualTest, PathsShowTheSame)
{
    const Scene scene = residualScene();
    Renderer ball = rendererOf(scene, RenderPath::ball), direct = rendererOf(scene, RenderPath::direct);
    EXPECT_LE(codeDifference(ball.picture(), direct.picture(), 4).share(), 0.01);
}

TEST_F(ResidualTest, OffIsTheBrdfAndOnComesBack)
{
    Scene scene = residualScene();
    Renderer renderer = rendererOf(scene, RenderPath::automatic);
    const Image on = renderer.picture();
    renderer.setResidual(ResidualUse::off);
    const Image off = renderer.picture();
    renderer.setResidual(ResidualUse::on);
    EXPECT_EQ(renderer.picture().values, on.values);
    EXPECT_NE(off.values, on.values);
    scene.surface.residual = {};
    Renderer without = rendererOf(scene, RenderPath::automatic);
    // The one draws albedo factors of 1 from half floats, the other plain balls.
    EXPECT_LE(codeDifference(off, without.picture(), 1).share(), 0.002);
}

TEST_F(ResidualTest, AloneIsGreyWhereTheLayerHasNothing)
{
    Scene scene = residualScene();
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

TEST_F(ResidualTest, IsLeftOutOfOtherViews)
{
    Scene scene = residualScene();
    scene.view = glm::normalize(glm::vec3(0.2f, 0, 1));
    Renderer renderer(*context);
    EXPECT_TRUE(framesMatch(renderer.render(scene), renderReference(scene)));
}

} // namespace
} // namespace nacre::test
