// Real captures, as others made them.
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/capture/capture.h"
#include "acquisition/capture/observations.h"
#include "tests/support/data_folder.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

TEST(CaptureData, PsmObjectsWithTheirSpheres)
{
    NACRE_REQUIRE_DATA("psm");
    CaptureOptions options;
    options.mirrorSphere = dataFolder() / "psm" / "chrome";
    options.diffuseSphere = dataFolder() / "psm" / "gray";
    options.rig = dataFolder() / "psm" / "lights.txt";
    for (const std::string name : {"buddha", "cat", "horse"}) {
        const Capture capture = loadCapture(dataFolder() / "psm" / name, options);
        EXPECT_EQ(capture.layout, CaptureLayout::uw);
        EXPECT_EQ(capture.name, name);
        EXPECT_EQ(capture.width, 512);
        EXPECT_EQ(capture.height, 340);
        ASSERT_EQ(capture.photographs.size(), 12u);
        EXPECT_EQ(capture.photographs[11].name, name + ".11.tga");
        EXPECT_EQ(capture.mirrorSphere->photographs[11].name, "chrome.11.tga");
        EXPECT_EQ(capture.curve, TransferCurve::linear);
        ASSERT_EQ(capture.lights.size(), 12u);
        EXPECT_NEAR(capture.lights[1].direction.z, 0.981606f, 1e-5f);
        EXPECT_GT(capture.maskPixels, 20000u);
        EXPECT_LT(capture.maskPixels, 60000u);
    }
}

// Correlation of what a pixel shows with n.l of the true normals; y of the lights times `flip`.
double shadingCorrelation(const Capture& capture, const Image& normals, float flip)
{
    ObservationReader reader(capture);
    Observations block;
    double n = 0, sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
    while (reader.next(block)) {
        for (size_t i = 0; i < block.pixels.size(); ++i) {
            const auto x = static_cast<int>(block.pixels[i] % capture.width);
            const auto y = static_cast<int>(block.pixels[i] / capture.width);
            const glm::vec3 normal = 2.0f * normals.rgb(x, y) - 1.0f;
            for (size_t j = 0; j < block.lightCount; ++j) {
                const glm::vec3 l = capture.lights[j].direction;
                const double shading = normal.x * l.x + normal.y * flip * l.y + normal.z * l.z;
                if (shading <= 0.1) {
                    continue; // attached shadows say nothing
                }
                const double shown = block.radianceOf(i)[j].y / capture.lights[j].irradiance.y;
                n += 1, sx += shading, sy += shown, sxx += shading * shading, syy += shown * shown,
                    sxy += shading * shown;
            }
        }
    }
    return (n * sxy - sx * sy) / std::sqrt((n * sxx - sx * sx) * (n * syy - sy * sy));
}

TEST(CaptureData, DiligentLightsAreInTheCameraFrame)
{
    NACRE_REQUIRE_DATA("diligent/ballPNG");
    const Capture capture = loadCapture(dataFolder() / "diligent" / "ballPNG");
    EXPECT_EQ(capture.layout, CaptureLayout::diligent);
    EXPECT_EQ(capture.truthNormals.filename(), "Normal_gt.mat");
    EXPECT_TRUE(capture.irradianceGiven);
    ASSERT_EQ(capture.lights.size(), 96u);
    EXPECT_EQ(capture.lights[0].irradiance, glm::vec3(1.2909f, 1.5776f, 2.1336f));
    const Image normals = loadImage(dataFolder() / "diligent" / "ballPNG" / "Normal_gt.png");
    const double asStated = shadingCorrelation(capture, normals, 1);
    const double flipped = shadingCorrelation(capture, normals, -1);
    RecordProperty("correlation", std::to_string(asStated));
    RecordProperty("flipped", std::to_string(flipped));
    EXPECT_GT(asStated, 0.8); // the ball is glossy
    EXPECT_GT(asStated, flipped + 0.3);
}

// psbox through our own layout: grey photographs, lights in three lines, mirror spheres as JPEGs with circles.
TEST(CaptureData, PsboxThroughJson)
{
    NACRE_REQUIRE_DATA("psbox");
    const std::string data = std::filesystem::canonical(dataFolder() / "psbox" / "data").string();
    std::vector<std::string> photographs;
    std::vector<std::string> mirrors;
    for (int i = 1; i <= 12; ++i) {
        photographs.push_back(fmt::format("\"{}/Objects/Image_{:02}.png\"", data, i));
        mirrors.push_back(fmt::format("\"{}/LightProbe-2/Image_{:02}.JPG\"", data, i));
    }
    const TempFolder folder;
    writeText(folder / "capture.json",
              fmt::format(R"({{"format": "nacre capture", "version": 1, "transfer": "linear", "photographs": [{}],
                  "lights": "{}/light_directions.txt",
                  "mirrorSphere": {{"photographs": [{}], "circle": [473.33, 485.07, 417.49]}}}})",
                          fmt::join(photographs, ","), data, fmt::join(mirrors, ",")));
    const Capture capture = loadCapture(folder.path());
    EXPECT_EQ(capture.width, 430);
    EXPECT_EQ(capture.height, 550);
    ASSERT_EQ(capture.lights.size(), 12u);
    EXPECT_NEAR(capture.lights[1].direction.x, -0.23338866f, 1e-5f);
    EXPECT_NEAR(capture.lights[1].direction.y, 0.35142828f, 1e-5f);
    EXPECT_FALSE(capture.irradianceGiven);
    EXPECT_EQ(capture.mirrorSphere->photographs.size(), 12u);
    ObservationReader reader(capture);
    Observations block;
    ASSERT_TRUE(reader.next(block));
    EXPECT_EQ(block.pixels.size(), size_t{430} * 550);
    EXPECT_EQ(block.radiance[1000].x, block.radiance[1000].z);
}

// A dome's list for ball: names of another machine, another extension, lights as they were.
TEST(CaptureData, BallAsAnRtiFolder)
{
    NACRE_REQUIRE_DATA("diligent/ballPNG");
    const Capture ball = loadCapture(dataFolder() / "diligent" / "ballPNG");
    const TempFolder folder;
    std::string lines = "96\r\n";
    for (size_t i = ball.photographs.size(); i-- > 0;) { // backwards: the names count
        const std::filesystem::path file = ball.photographs[i].exposures[0].file;
        std::filesystem::create_symlink(std::filesystem::absolute(file), folder / file.filename());
        const glm::vec3 l = ball.lights[i].direction;
        lines += fmt::format("D:\\dome 2\\{}.dng\t{} {} {}\r\n", file.stem().string(), l.x, l.y, l.z);
    }
    writeText(folder / "dome.lp", lines);
    CaptureOptions options;
    options.mask = dataFolder() / "diligent" / "ballPNG" / "mask.png";
    const Capture capture = loadCapture(folder.path(), options);
    EXPECT_EQ(capture.layout, CaptureLayout::rti);
    EXPECT_EQ(capture.maskPixels, ball.maskPixels);
    ASSERT_EQ(capture.photographs.size(), 96u);
    for (size_t i = 0; i < 96; ++i) {
        EXPECT_EQ(capture.photographs[i].name, ball.photographs[95 - i].name);
        EXPECT_LT(glm::length(capture.lights[i].direction - ball.lights[95 - i].direction), 1e-5f);
    }
}

} // namespace
} // namespace nacre
