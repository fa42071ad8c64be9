// Views against their twins on the CPU.
#include <cstdio>

#include <glm/geometric.hpp>

#include "engine/files/measures.h"
#include "engine/gpu/renderer.h"
#include "shared/layout.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/scenes.h"

namespace nacre::test {
namespace {

// Stripes of two materials and of none.
Scene stripedScene()
{
    Scene scene = glossyScene(150, 100);
    scene.surface.materials.push_back(scene.surface.materials[0]);
    for (size_t i = 0; i < scene.surface.labels.size(); ++i) {
        const size_t stripe = i / 7 % 3;
        scene.surface.labels[i] = stripe == 2 ? Surface::kNoMaterial : static_cast<uint8_t>(stripe);
    }
    return scene;
}

// Covered where thetaH is below half of the first axis (22.5 degrees).
void coverTheHighlight(Material& material)
{
    BrdfTable& table = material.table;
    for (size_t texel = 0; texel < table.confidence.size(); ++texel) {
        table.confidence[texel] = static_cast<int>(texel) % table.size.x < table.size.x / 2 ? 1.0f : 0.0f;
    }
}

// As known up to there, and expected to be off by half beyond.
void tellErrors(Material& material)
{
    coverTheHighlight(material);
    for (const float covered : material.table.confidence) {
        material.table.error.push_back(0.5f - 0.45f * covered);
    }
    std::fill(material.table.confidence.begin(), material.table.confidence.end(), 0.0f);
}

class FalseColourTest : public GpuTest {
protected:
    static Renderer rendererOf(const Scene& scene, Show show)
    {
        Renderer renderer(*context);
        renderer.setSurface(scene.surface);
        renderer.setLights(scene.lights);
        renderer.setView(scene.view);
        renderer.setShow(show);
        return renderer;
    }

    // 16-bit normals may round a code the other way, and turn the last pixel of a rim or of a border of coverage.
    static void expectTwins(const Scene& scene, Show show)
    {
        const Image picture = rendererOf(scene, show).picture(), twin = referenceFalseColour(scene, show, {});
        size_t off = 0, lit = 0;
        for (size_t i = 0; i < picture.pixelCount(); ++i) {
            float worst = 0;
            for (size_t c = 0; c < 3; ++c) {
                worst = std::max(worst, std::abs(picture.values[3 * i + c] - twin.values[3 * i + c]));
                lit += twin.values[3 * i + c] > 0;
            }
            off += worst > 1.01f / 255;
        }
        EXPECT_GT(lit, picture.pixelCount() / 4);
        EXPECT_LE(static_cast<double>(off), 0.002 * static_cast<double>(picture.pixelCount())) << off;
    }

    static size_t stripes(const Image& picture)
    {
        size_t found = 0;
        for (size_t i = 0; i < picture.pixelCount(); ++i) {
            const auto x = static_cast<int>(i % picture.width), y = static_cast<int>(i / picture.width);
            const glm::vec3 hatch = hatched(glm::vec3(0), {x, y});
            found += hatch != glm::vec3(0) && glm::length(picture.rgb(x, y) - hatch) < 0.005f;
        }
        return found;
    }
};

TEST_F(FalseColourTest, IsItsTwin)
{
    Scene side = glossyScene(150, 100);
    side.view = glm::normalize(glm::vec3(0.4f, -0.2f, 1));
    for (const Scene& scene : {glossyScene(150, 100), stripedScene(), side}) {
        for (const Show show : {Show::normals, Show::labels, Show::thetaH, Show::thetaD}) {
            SCOPED_TRACE(static_cast<int>(show));
            expectTwins(scene, show);
        }
    }
}

TEST_F(FalseColourTest, CoverageIsItsTwin)
{
    for (Scene scene : {glossyScene(150, 100), stripedScene()}) {
        coverTheHighlight(scene.surface.materials[0]);
        expectTwins(scene, Show::coverage);
        EXPECT_GT(stripes(rendererOf(scene, Show::coverage).picture()), 250u);
        scene.surface.materials[0] = glossyMaterial({kNatural, kHalfPi});
        tellErrors(scene.surface.materials[0]);
        expectTwins(scene, Show::coverage);
        EXPECT_GT(stripes(rendererOf(scene, Show::coverage).picture()), 250u);
    }
}

// Light that the height keeps off adds no error; errors add up over two draws of lights.
TEST_F(FalseColourTest, CoverageKnowsShadowsAndManyLights)
{
    Scene scene = glossyScene(150, 100);
    BrdfTable& table = scene.surface.materials[0].table;
    for (size_t texel = 0; texel < table.values.size(); ++texel) { // beyond half of thetaD's range uncertain
        table.error.push_back(static_cast<int>(texel) / table.size.x % table.size.y < table.size.y / 2 ? 0.0f : 0.5f);
    }
    scene.lights = capOfLights(kLightsPerGroup, 20);
    for (const float side : {-1.0f, 1.0f}) {
        scene.lights.push_back({glm::normalize(glm::vec3(side, 0.3f, 0.15f)), glm::vec3(3)});
    }
    Image& height = scene.surface.height = Image(150, 100, 1);
    for (int y = 0; y < height.height; ++y) {
        height.at(20, y) = height.at(130, y) = 40; // walls before lights from the sides
    }
    scene.surface.horizon = horizonMap(scene.surface.normals, scene.surface.height);
    const size_t shadowed = stripes(rendererOf(scene, Show::coverage).picture());
    expectTwins(scene, Show::coverage);
    EXPECT_GT(shadowed, 100u);
    scene.surface.horizon = {};
    EXPECT_GT(stripes(rendererOf(scene, Show::coverage).picture()), shadowed + 250);
}

TEST_F(FalseColourTest, OnlyWhatWasNotMeasuredIsHatched)
{
    Scene scene = glossyScene(150, 100); // covered up to thetaD of 45 degrees
    EXPECT_EQ(stripes(rendererOf(scene, Show::coverage).picture()), 0u);
    scene.lights[1].direction = glm::normalize(glm::vec3(1, 0, -0.1f));
    EXPECT_GT(stripes(rendererOf(scene, Show::coverage).picture()), 250u);
    std::fill(scene.surface.materials[0].table.confidence.begin(), scene.surface.materials[0].table.confidence.end(),
              0.0f);
    EXPECT_EQ(stripes(rendererOf(scene, Show::coverage).picture()), 0u) << "a table without coverage says nothing";
}

TEST_F(FalseColourTest, CoverageIsThePictureBetweenTheStripes)
{
    Scene scene = glossyScene(150, 100);
    coverTheHighlight(scene.surface.materials[0]);
    Renderer renderer = rendererOf(scene, Show::coverage);
    const Image hatch = renderer.picture();
    EXPECT_EQ(renderer.pathTaken(), RenderPath::direct);
    renderer.setShow(Show::picture);
    renderer.setPath(RenderPath::direct);
    const Image picture = renderer.picture();
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            if (hatched(glm::vec3(0), {x, y}) == glm::vec3(0)) {
                ASSERT_EQ(hatch.rgb(x, y), picture.rgb(x, y));
            }
        }
    }
}

TEST_F(FalseColourTest, OnlyWhatAViewDependsOnDrawsItAgain)
{
    const Scene scene = glossyScene(60, 40);
    Renderer renderer = rendererOf(scene, Show::normals);
    renderer.drawPicture();
    renderer.setLights(std::span(scene.lights).first(1));
    renderer.setDisplay({.exposureStops = 1});
    renderer.setPath(RenderPath::direct);
    renderer.drawPicture();
    EXPECT_EQ(renderer.drawnPictures(), 1u);
    renderer.setShow(Show::thetaH);
    renderer.drawPicture();
    renderer.setDisplay({.exposureStops = 2});
    renderer.drawPicture();
    EXPECT_EQ(renderer.drawnPictures(), 2u);
    renderer.setLights(scene.lights);
    renderer.drawPicture();
    EXPECT_EQ(renderer.drawnPictures(), 3u);
    renderer.setShow(Show::picture);
    Renderer fresh = rendererOf(scene, Show::picture);
    fresh.setPath(RenderPath::direct);
    fresh.setDisplay({.exposureStops = 2});
    EXPECT_EQ(renderer.picture().values, fresh.picture().values) << "what was shown before leaves no trace";
}

} // namespace
} // namespace nacre::test
