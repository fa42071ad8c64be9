// Lights near the object on the device, against the twin on the CPU.
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/files/error.h"
#include "engine/files/measures.h"
#include "engine/gpu/renderer.h"
#include "engine/scene/reference.h"
#include "engine/surface/height_from_normals.h"
#include "engine/surface/object_places.h"
#include "shared/layout.h"
#include "tests/gpu/frame_match.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/scenes.h"

namespace nacre::test {
namespace {

class NearLightTest : public GpuTest {
protected:
    static void expectTwins(const Scene& scene)
    {
        EXPECT_TRUE(framesMatch(Renderer(*context).render(scene), renderReference(scene)));
    }
};

// glossyScene under lights of which every second one is near; the first group has a distant one.
Scene nearScene(int width, int height, int lights = kLightsPerGroup + 2)
{
    Scene scene = glossyScene(width, height);
    scene.lights = capOfLights(lights, 70);
    for (size_t i = 1; i < scene.lights.size(); i += 2) {
        scene.lights[i].distance = 0.8f + 0.3f * static_cast<float>(i);
    }
    return scene;
}

Scene withHeight(Scene scene)
{
    scene.surface.height = heightFromNormals(scene.surface.normals).height;
    return scene;
}

TEST_F(NearLightTest, IsTheTwins)
{
    expectTwins(nearScene(257, 131));
    expectTwins(withHeight(nearScene(128, 128)));
    Scene natural = withHeight(nearScene(96, 96));
    natural.surface.materials = {glossyMaterial({kNatural, kHalfPi})};
    expectTwins(natural);
    Scene aside = withHeight(nearScene(96, 96));
    aside.view = glm::normalize(glm::vec3(0.4f, -0.2f, 0.9f));
    expectTwins(aside);
}

TEST_F(NearLightTest, ShadowsFallFromWhereEachPixelMeetsTheLight)
{
    Scene scene = withHeight(nearScene(120, 90));
    scene.surface.horizon = horizonMap(scene.surface.normals, scene.surface.height);
    expectTwins(scene);
}

TEST_F(NearLightTest, ALensIsTheTwins)
{
    Scene scene = withHeight(nearScene(120, 90));
    scene.surface.camera = glm::vec3(0.1f, -0.2f, 1.4f);
    expectTwins(scene);
    scene.surface.horizon = horizonMap(scene.surface.normals, heightInPicture(scene.surface));
    expectTwins(scene);
    for (Light& light : scene.lights) {
        light.distance = std::numeric_limits<float>::infinity();
    }
    expectTwins(scene);
    Renderer renderer(*context);
    const Frame lens = renderer.render(scene);
    EXPECT_EQ(renderer.pathTaken(), RenderPath::direct);
    renderer.setShow(Show::coverage);
    // Places are halves and normals packed there: where the surface just turns away from the camera, pixels are of one
    // side or the other.
    EXPECT_LE(codeDifference(renderer.picture(), referenceFalseColour(scene, Show::coverage, Display{}), 4).share(),
              0.003);
    renderer.setShow(Show::picture);
    EXPECT_NE(renderer.whyDirect().find("camera is near"), std::string::npos);
    scene.surface.camera.reset();
    EXPECT_FALSE(framesMatch(lens, renderReference(scene)));
}

// More pixels than one band of radiance holds: each knows its own place all the same.
TEST_F(NearLightTest, IsTheTwinsInBands)
{
    Scene scene = nearScene(1200, 900, 1);
    scene.lights[0].distance = 1;
    expectTwins(scene);
}

TEST_F(NearLightTest, PicturesAreTheReferences)
{
    const Scene scene = withHeight(nearScene(120, 100)); // few enough for exposure to look at all;
    Renderer renderer(*context);
    renderer.render(scene);
    const Display display{.exposureStops = renderer.automaticExposure()};
    EXPECT_FLOAT_EQ(display.exposureStops, automaticExposure(renderer.radiance()));
    renderer.setDisplay(display);
    const std::vector<uint8_t> all(size_t{120} * 100, 1);
    EXPECT_GE(picturePsnr(renderer.picture(), displayedImage(renderReference(scene), display), all), 55);
    renderer.setShow(Show::coverage);
    EXPECT_GE(picturePsnr(renderer.picture(), referenceFalseColour(scene, Show::coverage, display), all), 45);
}

TEST_F(NearLightTest, ComesAndGoesWithoutAMemory)
{
    const Scene near = nearScene(150, 100);
    Scene distant = near;
    for (Light& light : distant.lights) {
        light.distance = std::numeric_limits<float>::infinity();
    }
    Renderer renderer(*context);
    const Frame before = renderer.render(distant);
    const Image picture = renderer.picture();
    EXPECT_EQ(renderer.pathTaken(), RenderPath::ball);
    EXPECT_NE(renderer.render(near.lights).values, before.values);
    EXPECT_EQ(renderer.radiance().values, Renderer(*context).render(near).values);
    EXPECT_NE(renderer.picture().values, picture.values);
    EXPECT_EQ(renderer.render(distant.lights).values, before.values);
    EXPECT_EQ(renderer.picture().values, picture.values);
}

TEST_F(NearLightTest, TakesTheDirectPathAndSaysWhy)
{
    Scene scene = nearScene(64, 64);
    Renderer renderer(*context);
    renderer.render(scene);
    EXPECT_EQ(renderer.pathTaken(), RenderPath::direct);
    EXPECT_NE(renderer.whyDirect().find("near lights"), std::string::npos);
    renderer.setPath(RenderPath::ball);
    EXPECT_THROW(renderer.pathTaken(), Error);
}

// From kDistantFrom on it is the distant picture to the byte, which it nears before.
TEST_F(NearLightTest, FarAwayIsTheDistantPicture)
{
    Scene scene = withHeight(glossyScene(96, 96));
    Renderer renderer(*context);
    const Frame distant = renderer.render(scene);
    const auto at = [&](float distance) {
        for (Light& light : scene.lights) {
            light.distance = distance;
        }
        return renderer.render(scene.lights);
    };
    const auto largest = [&](const Frame& frame) {
        float most = 0;
        for (size_t i = 0; i < frame.values.size(); ++i) {
            most = std::max(most, std::abs(frame.values[i] - distant.values[i]));
        }
        return most;
    };
    EXPECT_EQ(at(kDistantFrom).values, distant.values);
    const float middle = largest(at(20)), far = largest(at(200));
    EXPECT_GT(far, 0);
    EXPECT_LT(far, 0.12f * middle);
}

} // namespace
} // namespace nacre::test
