// The Vulkan frame against its twin on the CPU.
#include <cstdio>

#include <glm/geometric.hpp>

#include "engine/gpu/renderer.h"
#include "engine/scene/reference.h"
#include "shared/layout.h"
#include "tests/gpu/frame_match.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/scenes.h"

namespace nacre::test {
namespace {

class FrameTest : public GpuTest {
protected:
    static void expectTwins(const Scene& scene)
    {
        const auto match = framesMatch(Renderer(*context).render(scene), renderReference(scene));
        EXPECT_TRUE(match);
        if (match) {
            RecordProperty("figures", match.message());
            std::printf("  %s\n", match.message());
        }
    }
};

TEST_F(FrameTest, GlossyHighlights)
{
    expectTwins(glossyScene(256, 256));
}

TEST_F(FrameTest, NaturalCoordinates)
{
    Scene scene = glossyScene(256, 256);
    scene.surface.materials = {glossyMaterial({kNatural, kHalfPi})};
    expectTwins(scene);
}

TEST_F(FrameTest, OneWayCoordinates)
{
    Scene scene = glossyScene(256, 256);
    scene.surface.materials = {oneWayMaterial()};
    expectTwins(scene);
}

TEST_F(FrameTest, OddAndNarrowSizes)
{
    expectTwins(glossyScene(257, 31));
    expectTwins(glossyScene(1, 97));
}

TEST_F(FrameTest, LightsBeyondOneGroup)
{
    for (const int count : {kLightsPerGroup, kLightsPerGroup + 1, 2 * kLightsPerGroup + 77}) {
        SCOPED_TRACE(count);
        Scene scene = glossyScene(64, 64);
        scene.lights = capOfLights(count, 75);
        expectTwins(scene);
    }
}

TEST_F(FrameTest, ColouredLights)
{
    Scene scene = glossyScene(128, 128);
    scene.lights = {{glm::normalize(glm::vec3(-0.6f, 0.2f, 0.8f)), {5, 0, 0}},
                    {glm::normalize(glm::vec3(0.6f, 0.1f, 0.8f)), {0, 0.2f, 3}}};
    expectTwins(scene);
}

TEST_F(FrameTest, GrazingAndBackLights)
{
    Scene scene = glossyScene(256, 256);
    scene.surface.materials = {glossyMaterial({kHalfDifference, kHalfPi})};
    scene.lights = {{glm::normalize(glm::vec3(1, 0, 0.01f)), glm::vec3(1)},
                    {glm::normalize(glm::vec3(-1, -1, -0.5f)), glm::vec3(1)}};
    expectTwins(scene);
}

TEST_F(FrameTest, ViewFromTheSide)
{
    Scene scene = glossyScene(128, 128);
    scene.view = glm::normalize(glm::vec3(0.5f, -0.3f, 0.8f));
    expectTwins(scene);
}

TEST_F(FrameTest, TwoMaterialsAndNone)
{
    Scene scene = glossyScene(160, 90);
    const LambertGgx dull{.diffuse = {0.1f, 0.5f, 0.2f}, .specular = glm::vec3(0.04f), .alpha = 0.5f};
    scene.surface.materials.push_back(materialOf(dull, {kNatural, kHalfPi}, {16, 16, 32}));
    scene.lights = capOfLights(kLightsPerGroup + 3, 60);
    for (size_t i = 0; i < scene.surface.labels.size(); ++i) {
        const size_t stripe = i / 7 % 3;
        scene.surface.labels[i] = stripe == 2 ? Surface::kNoMaterial : static_cast<uint8_t>(stripe);
    }
    expectTwins(scene);
}

TEST_F(FrameTest, AlbedoFactor)
{
    Scene scene = glossyScene(128, 64);
    scene.surface.albedo = Image(128, 64, 3);
    for (size_t i = 0; i < scene.surface.albedo.values.size(); ++i) {
        scene.surface.albedo.values[i] = 0.1f + 0.013f * static_cast<float>(i % 150);
    }
    expectTwins(scene);
}

TEST_F(FrameTest, PixelsWithoutNormalOrLightAreBlack)
{
    Scene scene = glossyScene(64, 64);
    const Frame frame = Renderer(*context).render(scene);
    size_t empty = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            if (scene.surface.normals.confidence[scene.surface.normals.index(x, y)] == 0) {
                ++empty;
                EXPECT_EQ(frame.rgb(x, y), glm::vec3(0));
            }
        }
    }
    EXPECT_GT(empty, 100u);
    scene.lights.clear();
    for (const float value : Renderer(*context).render(scene).values) {
        ASSERT_EQ(value, 0);
    }
}

// Confidence alone decides, whatever the normal and the label say.
TEST_F(FrameTest, NoConfidenceIsNoNormal)
{
    Scene scene = glossyScene(64, 64);
    for (size_t i = 0; i < scene.surface.labels.size(); i += 2) {
        scene.surface.normals.confidence[i] = 0;
    }
    expectTwins(scene);
}

TEST_F(FrameTest, SameBytesTwice)
{
    const Scene scene = glossyScene(200, 100);
    Renderer renderer(*context);
    const Frame first = renderer.render(scene);
    EXPECT_EQ(first.values, renderer.render(scene.lights, scene.view).values);
    EXPECT_EQ(first.values, Renderer(*context).render(scene).values);
    EXPECT_EQ(renderReference(scene, 1).values, renderReference(scene, 2).values);
}

// Doubled light, doubled radiance; two lights together are the sum of each alone.
TEST_F(FrameTest, LightAddsUp)
{
    Scene scene = glossyScene(64, 64);
    scene.lights = capOfLights(2, 50);
    Renderer renderer(*context);
    const Frame both = renderer.render(scene);
    const Frame one = renderer.render({{scene.lights[0]}});
    const Frame other = renderer.render({{scene.lights[1]}});
    Frame sum = one;
    for (size_t i = 0; i < sum.values.size(); ++i) {
        sum.values[i] += other.values[i];
    }
    EXPECT_TRUE(framesMatch(both, sum));
}

// The comparison must refuse what is wrong: each of these has been a bug of somebody's renderer.
TEST_F(FrameTest, MutantsDoNotMatch)
{
    Scene scene = glossyScene(96, 96);
    scene.lights = {{glm::normalize(glm::vec3(0.3f, 0.4f, 0.87f)), {1, 2, 3}}};
    const Frame expected = renderReference(scene);
    const Frame actual = Renderer(*context).render(scene);
    ASSERT_TRUE(framesMatch(actual, expected));

    EXPECT_FALSE(framesMatch(Frame(96, 96, 3), expected)) << "black frame";

    Scene flippedGreen = scene;
    Frame noCosine = actual, swapped = actual, exposed = actual;
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 96; ++x) {
            glm::vec3& n = flippedGreen.surface.normals.normals[scene.surface.normals.index(x, y)];
            n.y = -n.y;
            const glm::vec3 value = actual.rgb(x, y);
            const float cosine =
                glm::dot(scene.surface.normals.normals[actual.index(x, y) / 3], scene.lights[0].direction);
            noCosine.setRgb(x, y, cosine > 0 ? value / cosine : value);
            swapped.setRgb(x, y, {value.z, value.y, value.x});
            exposed.setRgb(x, y, value * 1.003f);
        }
    }
    EXPECT_FALSE(framesMatch(Renderer(*context).render(flippedGreen), expected)) << "flipped green";
    EXPECT_FALSE(framesMatch(noCosine, expected)) << "no cosine";
    EXPECT_FALSE(framesMatch(swapped, expected)) << "red and blue swapped";
    EXPECT_FALSE(framesMatch(exposed, expected)) << "three permille brighter";
}

} // namespace
} // namespace nacre::test
