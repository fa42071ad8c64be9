// Scenes at the ends of what can be asked for: refused clearly, or drawn right, within the memory that is promised.
#include <cstdio>

#include <glm/geometric.hpp>

#include "engine/brdf/brdf_tabulation.h"
#include "engine/files/measures.h"
#include "engine/gpu/check.h"
#include "engine/gpu/renderer.h"
#include "engine/scene/reference.h"
#include "tests/gpu/frame_match.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/scenes.h"
#include "tests/support/expect_error.h"

namespace nacre::test {
namespace {

constexpr VkDeviceSize kMostBytes = VkDeviceSize{256} << 20;

class ExtremesTest : public GpuTest {};

TEST_F(ExtremesTest, ASurfaceBeyondTheDeviceIsRefused)
{
    const int limit = static_cast<int>(context->limits().maxImageDimension2D);
    Renderer renderer(*context);
    const Scene scene = glossyScene(8, 8);
    for (const auto& [width, height] : {std::pair(limit + 1, 1), std::pair(1, limit + 1), std::pair(0, 0)}) {
        const Surface surface = transferredSurface(NormalMap(width, height), scene.surface.materials[0]);
        expectError([&] { renderer.setSurface(surface); }, {"cannot draw", std::to_string(limit)});
    }
    renderer.setSurface(scene.surface);
    renderer.setLights(scene.lights);
    EXPECT_TRUE(framesMatch(renderer.radiance(), renderReference(scene))) << "a refusal leaves the renderer sound";
}

TEST_F(ExtremesTest, TenThousandLightsAddUp)
{
    Scene scene = glossyScene(24, 16);
    scene.lights = capOfLights(10000, 60);
    Renderer renderer(*context);
    EXPECT_TRUE(framesMatch(renderer.render(scene), renderReference(scene)));
    const Display display{.exposureStops = renderer.automaticExposure()};
    renderer.setDisplay(display);
    const Image expected = displayedImage(renderReference(scene), display);
    for (const RenderPath path : {RenderPath::ball, RenderPath::direct}) {
        renderer.setPath(path);
        EXPECT_GE(picturePsnr(renderer.picture(), expected, std::vector<uint8_t>(24 * 16, 1)), 45);
    }
}

TEST_F(ExtremesTest, ASurfaceWithoutMaterialsIsBlack)
{
    Scene scene = glossyScene(20, 10);
    scene.surface.materials.clear();
    Renderer renderer(*context);
    renderer.setSurface(scene.surface);
    renderer.setLights(scene.lights);
    EXPECT_EQ(renderer.automaticExposure(), 0);
    for (const Show show : {Show::picture, Show::normals, Show::labels, Show::coverage, Show::thetaH}) {
        renderer.setShow(show);
        EXPECT_EQ(renderer.picture().values, Image(20, 10, 3).values) << static_cast<int>(show);
    }
}

TEST_F(ExtremesTest, BlackLightsAndNoneAreBlack)
{
    Scene scene = glossyScene(20, 10);
    const Light black{{0, 0, 1}, glm::vec3(0)};
    for (const std::vector<Light>& lights : {std::vector<Light>{}, std::vector<Light>{black}}) {
        Renderer renderer(*context);
        renderer.setSurface(scene.surface);
        renderer.setLights(lights);
        for (const RenderPath path : {RenderPath::ball, RenderPath::direct}) {
            renderer.setPath(path);
            EXPECT_EQ(renderer.picture().values, Image(20, 10, 3).values);
        }
    }
}

TEST_F(ExtremesTest, BandsOfRowsAreSeamless)
{
    Scene scene = glossyScene(1300, 901); // more than a band of a million
    static_assert(1300 * 901 > DirectFrame::kBandTexels);
    Renderer renderer(*context);
    const Frame radiance = renderer.render(scene);
    EXPECT_TRUE(framesMatch(radiance, renderReference(scene)));
    const Display display{.exposureStops = automaticExposure(radiance)};
    renderer.setDisplay(display);
    renderer.setPath(RenderPath::direct);
    EXPECT_GE(picturePsnr(renderer.picture(), displayedImage(radiance, display), std::vector<uint8_t>(1300 * 901, 1)),
              58);
}

// All pixels of a small picture; of a large one a sample: its 99th percentile is that of 98.8 to 99.2 % of all.
TEST_F(ExtremesTest, ASampleTellsTheExposure)
{
    for (const int side : {100, 500}) {
        const Scene scene = glossyScene(side, side);
        Renderer renderer(*context);
        const Frame radiance = renderer.render(scene);
        const bool all = static_cast<size_t>(side) * side <= Renderer::kExposurePixels;
        EXPECT_NEAR(renderer.automaticExposure(), automaticExposure(radiance), all ? 1e-3f : 0.05f);
    }
}

TEST_F(ExtremesTest, DirectPicturesAndRadianceAt4kFitIntoTheMemory)
{
    const LambertGgx model{.diffuse = glm::vec3(0.4f), .specular = glm::vec3(0.05f), .alpha = 0.1f};
    Scene scene;
    scene.surface = transferredSurface(bumpyNormals(3840, 2160), {"ggx", tabulatedBrdf(model), {}});
    scene.surface.materials.resize(4, scene.surface.materials[0]);
    scene.surface.albedo = Image(3840, 2160, 3, 1.0f);
    Renderer renderer(*context);
    renderer.setSurface(std::move(scene.surface));
    renderer.setLights(capOfLights(1, 60)); // lights take no memory to speak of
    renderer.setPath(RenderPath::direct);
    renderer.setDisplay({.exposureStops = renderer.automaticExposure()});
    renderer.drawPicture();
    EXPECT_LE(renderer.deviceBytes(), kMostBytes);
    std::printf("  picture: %llu MiB on the device\n", static_cast<unsigned long long>(renderer.deviceBytes() >> 20));
    renderer.radiance();
    EXPECT_LE(renderer.deviceBytes(), kMostBytes);
    std::printf("  and radiance: %llu MiB\n", static_cast<unsigned long long>(renderer.deviceBytes() >> 20));
}

TEST(CheckVulkan, SaysWhatHappened)
{
    EXPECT_NO_THROW(checkVulkan(VK_SUCCESS, "vkAny"));
    expectError([] { checkVulkan(VK_ERROR_DEVICE_LOST, "vkAny"); },
                {"the Vulkan device was lost", "vkAny", "VK_ERROR_DEVICE_LOST", "another device"});
    expectError([] { checkVulkan(VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkAny"); },
                {"vkAny answered VK_ERROR_OUT_OF_DEVICE_MEMORY"});
}

} // namespace
} // namespace nacre::test
