// nacre render and nacre info as their users start them.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/materials/scale_bar.h"
#include "engine/files/measures.h"
#include "engine/scene/reference.h"
#include "tests/gpu/frame_match.h"
#include "tests/gpu/scenes.h"
#include "tests/support/expect_one_line.h"
#include "tests/support/run_nacre.h"
#include "tests/support/small_capture.h"

namespace nacre::test {
namespace {

class RenderTest : public testing::Test {
protected:
    RenderTest()
    {
        scene_ = glossyScene(60, 40);
        scene_.surface.lights = {{"a.png", {{0, 0, 1}, {1, 1, 1}}},
                                 {"b.png", {glm::vec3(0.6f, 0, 0.8f), {2, 1, 0.5f}}}};
        saveSurface(folder_ / "s.nacre", scene_.surface, false);
    }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    // Runs render on the surface with more arguments, all to be written to `output`.
    ProgramRun render(const std::string& output, std::vector<std::string> more, const std::string& environment = "")
    {
        std::vector<std::string> arguments = {"render", path("s.nacre"), "-o", path(output)};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runNacre(arguments, environment);
    }

    Frame expected(const Surface& surface, const std::vector<Light>& lights) const
    {
        Scene scene = scene_;
        scene.surface = surface;
        scene.lights = lights;
        return renderReference(scene);
    }

    void expectRefusal(const ProgramRun& run, int exitCode, const std::string& fragment)
    {
        expectOneLine(run, exitCode, {fragment});
        EXPECT_EQ(run.out, "");
        EXPECT_FALSE(std::filesystem::exists(path("new.png")));
    }

    TempFolder folder_;
    Scene scene_;
};

TEST_F(RenderTest, ExrHoldsTheReferencesRadiance)
{
    const ProgramRun run =
        render("new.exr", {"--light", "-3,2,5", "--light", "captured:2", "--light", "0,1,2,0.5,0,3"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const Frame frame = expected(scene_.surface, {{glm::normalize(glm::vec3(-3, 2, 5)), glm::vec3(1)},
                                                  scene_.surface.lights[1].light,
                                                  {glm::normalize(glm::vec3(0, 1, 2)), {0.5f, 0, 3}}});
    EXPECT_TRUE(framesMatch(loadImage(path("new.exr")), frame));
    EXPECT_NE(run.out.find("3 lights"), std::string::npos) << run.out;
}

TEST_F(RenderTest, FirstCapturedLightIsTheDefault)
{
    ASSERT_EQ(render("new.exr", {"--quiet"}).exitCode, 0);
    EXPECT_TRUE(framesMatch(loadImage(path("new.exr")), expected(scene_.surface, {scene_.surface.lights[0].light})));
}

TEST_F(RenderTest, PngIsExposedAndSaysItsDevice)
{
    const ProgramRun run = render("new.png", {"--light", "0,0,1", "--path", "direct"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const Frame frame = expected(scene_.surface, {{{0, 0, 1}, {1, 1, 1}}});
    const Image picture = displayedImage(frame, {.exposureStops = automaticExposure(frame)});
    const Image actual = loadImage(path("new.png"));
    ASSERT_EQ(actual.values.size(), picture.values.size());
    for (size_t i = 0; i < picture.values.size(); ++i) {
        ASSERT_NEAR(actual.values[i], picture.values[i], 1.001 / 255) << i;
    }
    EXPECT_NE(run.out.find("(automatic)"), std::string::npos) << run.out;
    EXPECT_NE(readImageAttribute(path("new.png"), "Software").find("nacre "), std::string::npos);
    EXPECT_FALSE(readImageAttribute(path("new.png"), "Device").empty());
    EXPECT_FALSE(readImageAttribute(path("new.png"), "Driver").empty());
}

TEST_F(RenderTest, ExposureCountsStops)
{
    ASSERT_EQ(render("a.png", {"--light", "0,0,1", "--exposure", "-2"}).exitCode, 0);
    ASSERT_EQ(render("b.png", {"--light", "0,0,1,0.25,0.25,0.25", "--exposure", "0"}).exitCode, 0);
    EXPECT_GT(picturePsnr(loadImage(path("a.png")), loadImage(path("b.png")), std::vector<uint8_t>(60 * 40, 1)), 50);
}

TEST_F(RenderTest, OntoOtherNormalsTakesTheMaterialAlone)
{
    const NormalMap sphere = sphereNormalMap(32);
    saveNormalMap(path("sphere.exr"), sphere);
    ASSERT_EQ(render("new.exr", {"--onto", path("sphere.exr"), "--light", "1,2,4"}).exitCode, 0);
    const Light light{glm::normalize(glm::vec3(1, 2, 4)), {1, 1, 1}};
    const Surface transferred = transferredSurface(sphere, scene_.surface.materials[0]);
    EXPECT_TRUE(framesMatch(loadImage(path("new.exr")), expected(transferred, {light})));

    ASSERT_EQ(render("other.exr", {"--onto", path("s.nacre"), "--light", "1,2,4"}).exitCode, 0);
    EXPECT_TRUE(framesMatch(loadImage(path("other.exr")), expected(scene_.surface, {light})));
}

// With green down in the file and told so, the picture is that of green up.
TEST_F(RenderTest, NormalYFlipsGreen)
{
    const NormalMap sphere = sphereNormalMap(32);
    NormalMap flipped = sphere;
    for (glm::vec3& n : flipped.normals) {
        n.y = -n.y;
    }
    saveNormalMap(path("up.png"), sphere);
    saveNormalMap(path("down.png"), flipped);
    ASSERT_EQ(render("up.exr", {"--onto", path("up.png"), "--light", "0,1,1"}).exitCode, 0);
    ASSERT_EQ(render("down.exr", {"--onto", path("down.png"), "--normal-y", "dx", "--light", "0,1,1"}).exitCode, 0);
    ASSERT_EQ(render("wrong.exr", {"--onto", path("down.png"), "--light", "0,1,1"}).exitCode, 0);
    // 16-bit codes lie unevenly about zero: flipping moves a normal by up to 1/65535.
    const std::vector<uint8_t> everywhere(32 * 32, 1);
    EXPECT_GT(radiancePsnr(loadImage(path("up.exr")), loadImage(path("down.exr")), everywhere, 1), 60);
    EXPECT_LT(radiancePsnr(loadImage(path("up.exr")), loadImage(path("wrong.exr")), everywhere, 1), 30);
}

TEST_F(RenderTest, SizeFitsWithBordersAndLabels)
{
    ASSERT_EQ(render("new.exr", {"--size", "60x100", "--light", "0,0,1"}).exitCode, 0);
    const Image fitted = loadImage(path("new.exr"));
    ASSERT_EQ(fitted.width, 60);
    ASSERT_EQ(fitted.height, 100);
    const Frame frame = expected(scene_.surface, {{{0, 0, 1}, {1, 1, 1}}});
    Frame bordered(60, 100, 3);
    std::copy(frame.values.begin(), frame.values.end(), bordered.values.begin() + bordered.index(0, 30));
    EXPECT_TRUE(framesMatch(fitted, bordered));
}

TEST_F(RenderTest, BadLightsAreUsageErrors)
{
    const std::pair<const char*, const char*> bad[] = {{"0,0,0", "not all 0"},
                                                       {"1,2", "x,y,z,r,g,b"},
                                                       {"1,2,3,4", "x,y,z,r,g,b"},
                                                       {"a,b,c", "x,y,z,r,g,b"},
                                                       {"nan,0,1", "x,y,z,r,g,b"},
                                                       {"1,2,3,", "x,y,z,r,g,b"},
                                                       {"0,0,-1", "straight behind"},
                                                       {"0,0,1,-1,0,0", "0 or more"},
                                                       {"captured:0", "captured:N with N from 1"},
                                                       {"captured:3", "captured:1 to captured:2"},
                                                       {"captured:x", "captured:N with N from 1"}};
    for (const auto& [light, fragment] : bad) {
        SCOPED_TRACE(light);
        expectRefusal(render("new.png", {"--light=" + std::string(light)}), 2, fragment);
    }
}

TEST_F(RenderTest, BadOptionsAreUsageErrors)
{
    expectRefusal(render("new.png", {"--size", "60"}), 2, "WIDTHxHEIGHT");
    expectRefusal(render("new.png", {"--size", "0x60"}), 2, "WIDTHxHEIGHT");
    expectRefusal(render("new.png", {"--device", "no such"}), 2, "0 = ");
    expectRefusal(render("new.png", {"--exposure", "inf"}), 2, "number of stops");
    expectRefusal(render("new.exr", {"--exposure", "1"}), 2, ".png only");
    expectRefusal(render("new.tga", {}), 2, ".png (8-bit sRGB) or .exr");
    expectRefusal(render("new.png", {"--onto", path("s.nacre"), "--normal-y", "up"}), 2, "gl (green points up)");
    expectRefusal(render("new.png", {"--onto", "make:moon"}), 2, "sphere");
    expectRefusal(render("new.png", {"--onto", path("mesh.obj")}), 3, "a mesh file");
    expectRefusal(render("new.png", {"--turn", "30,0"}), 3, "has no height, and cannot be turned");
    expectRefusal(render("new.png", {"--frames", "2", "--motion", "object"}), 3, "cannot be turned");
}

TEST_F(RenderTest, ViewRefusesPhotographsThatAreNone)
{
    expectRefusal(runNacre({"view", path("s.nacre"), "--headless", "-o", path("new.png"), "--capture", path("none")}),
                  3, "none");
}

TEST_F(RenderTest, ViewSaysWhatVerdictsNeed)
{
    expectRefusal(runNacre({"view", path("s.nacre"), "--headless", "-o", path("new.png"), "--light", "captured:1",
                            "--show", "verdicts"}),
                  2, "--capture FOLDER");
}

TEST_F(RenderTest, ViewWithoutAWindowTakesNoWindowsOptions)
{
    expectRefusal(runNacre({"view", path("s.nacre"), "--headless", "-o", path("new.png"), "--window", "64x48"}), 2,
                  "--window");
}

TEST_F(RenderTest, BadDataIsRefused)
{
    expectRefusal(render("new.png", {"--onto", path("nothing.exr")}), 3, "does not exist");
    expectRefusal(render("missing/new.png", {}), 3, "its folder does not exist");
    expectRefusal(render("new.png", {"--size", "99999x1"}), 3, "cannot draw 99999 x 1");
    expectRefusal(runNacre({"render", path("nothing.nacre"), "-o", path("new.png")}), 3, "is not a surface");
}

TEST_F(RenderTest, AnOutputThatExistsIsRefusedWithoutForce)
{
    writeText(folder_ / "old.png", "precious");
    expectRefusal(render("old.png", {}), 3, "--force");
    EXPECT_EQ(std::filesystem::file_size(path("old.png")), 8u);
    EXPECT_EQ(render("old.png", {"--force"}).exitCode, 0);
    EXPECT_EQ(loadImage(path("old.png")).width, 60);
}

TEST_F(RenderTest, WithoutAVulkanDeviceItSaysSo)
{
    const std::string none = "VK_ICD_FILENAMES=/nonexistent.json VK_DRIVER_FILES=/nonexistent.json";
    expectRefusal(render("new.png", {}, none), 3, "no Vulkan device; install a driver, e.g. mesa-vulkan-drivers");
    const ProgramRun info = runNacre({"info"}, none);
    EXPECT_EQ(info.exitCode, 0);
    EXPECT_NE(info.out.find("no Vulkan device"), std::string::npos) << info.out;
}

TEST_F(RenderTest, InfoTellsDevicesAndSurfaces)
{
    const ProgramRun devices = runNacre({"info"});
    EXPECT_EQ(devices.exitCode, 0);
    EXPECT_NE(devices.out.find("driver"), std::string::npos) << devices.out;

    const ProgramRun surface = runNacre({"info", path("s.nacre")});
    EXPECT_EQ(surface.exitCode, 0) << surface.err;
    for (const char* fragment : {"60x40", "64x24x16", "thetaD to 45.0 degrees", "captured:2", "36.87", "b.png"}) {
        EXPECT_NE(surface.out.find(fragment), std::string::npos) << fragment << " is not in " << surface.out;
    }
    EXPECT_EQ(runNacre({"info", path("nothing")}).exitCode, 3);
}

TEST_F(RenderTest, AStateFileIsTheCommandLine)
{
    writeText(folder_ / "scene.json", R"({"format": "nacre scene", "version": 1, "surface": "s.nacre",
        "light": ["captured:2", "soft:10:0,0.5,1"], "exposure": 0.5, "tone": "filmic", "size": "90x60"})");
    ASSERT_EQ(runNacre({"render", "--state", path("scene.json"), "-o", path("a.png")}).exitCode, 0);
    ASSERT_EQ(render("b.png", {"--light", "captured:2", "--light", "soft:10:0,0.5,1", "--exposure", "0.5", "--tone",
                               "filmic", "--size", "90x60"})
                  .exitCode,
              0);
    EXPECT_EQ(loadImage(path("a.png")).values, loadImage(path("b.png")).values);
    writeText(folder_ / "unknown.json", R"({"format": "nacre scene", "version": 1, "colour": 1})");
    expectRefusal(runNacre({"render", "--state", path("unknown.json"), "-o", path("new.png")}), 3, "'colour'");
    writeText(folder_ / "other.json", R"({"format": "nacre lights", "version": 1})");
    expectRefusal(runNacre({"render", "--state", path("other.json"), "-o", path("new.png")}), 3, "nacre scene");
}

TEST_F(RenderTest, TheCommandLineBeatsTheStateFile)
{
    writeText(folder_ / "scene.json", R"({"format": "nacre scene", "version": 1, "surface": "s.nacre",
        "light": ["captured:2", "0,0,1"], "exposure": 0.5, "size": "90x60"})");
    ASSERT_EQ(runNacre({"render", "--state", path("scene.json"), "--light", "captured:1", "--exposure", "-1", "-o",
                        path("a.png")})
                  .exitCode,
              0);
    ASSERT_EQ(render("b.png", {"--light", "captured:1", "--exposure", "-1", "--size", "90x60"}).exitCode, 0);
    EXPECT_EQ(loadImage(path("a.png")).values, loadImage(path("b.png")).values);
}

TEST_F(RenderTest, SequencesAreNumbered)
{
    ASSERT_EQ(render("turn.png", {"--light", "0.6,0,0.8", "--frames", "4"}).exitCode, 0);
    ASSERT_EQ(render("alone.png", {"--light", "0,0.6,0.8", "--exposure", "0"}).exitCode, 0);
    ASSERT_EQ(render("turned.png", {"--light", "0.6,0,0.8", "--frames", "4", "--exposure", "0"}).exitCode, 0);
    const Image second = loadImage(path("turned_0002.png")), alone = loadImage(path("alone.png"));
    EXPECT_GT(picturePsnr(second, alone, std::vector<uint8_t>(60 * 40, 1)), 45) << "a quarter turn of the light";
    EXPECT_TRUE(std::filesystem::exists(path("turn_0004.png")));
    expectRefusal(render("turn.png", {"--frames", "4"}), 3, "--force");
    expectRefusal(render("new.png", {"--frames", "0"}), 2, "1 to 10000");
    expectRefusal(render("new.png", {"--motion", "jump"}), 2, "turntable, sweep, object or none");
}

TEST_F(RenderTest, PathsAgreeAndSayWhatTheyAre)
{
    const ProgramRun direct = render("d.png", {"--path", "direct"}), ball = render("b.png", {"--path", "ball"});
    ASSERT_EQ(direct.exitCode, 0) << direct.err;
    ASSERT_EQ(ball.exitCode, 0) << ball.err;
    EXPECT_GT(picturePsnr(loadImage(path("d.png")), loadImage(path("b.png")), std::vector<uint8_t>(60 * 40, 1)), 45);
    EXPECT_NE(ball.out.find("path         ball ("), std::string::npos) << ball.out;
    EXPECT_NE(ball.out.find("MiB on the device"), std::string::npos) << ball.out;
    expectRefusal(render("new.png", {"--path", "ball", "--view", "0.5,0,1"}), 2, "view from the front");
    expectRefusal(render("new.png", {"--view", "0,0,-1"}), 2, "z above 0");
    expectRefusal(render("new.png", {"--light", "soft:0:0,0,1"}), 2, "above 0");
    expectRefusal(render("new.png", {"--environment", path("nothing.exr")}), 3, "does not exist");
}

// White pixels in a row of the picture from x on.
int whiteFrom(const Image& picture, int x, int y)
{
    int end = x;
    while (end < picture.width && picture.rgb(end, y) == glm::vec3(1)) {
        ++end;
    }
    return end - x;
}

TEST_F(RenderTest, AScaleBarIsAsLongAsItSays)
{
    scene_.surface.pixelsPerMillimetre = 3;
    saveSurface(folder_ / "s.nacre", scene_.surface, true);
    ASSERT_EQ(render("bar.png", {"--scale", "4", "--scale-bar"}).exitCode, 0);
    ASSERT_EQ(render("bare.png", {"--scale", "4"}).exitCode, 0);
    const Image with = loadImage(path("bar.png")), without = loadImage(path("bare.png"));
    int longest = 0;
    for (int y = with.height / 2; y < with.height; ++y) {
        for (int x = 0; x < with.width; ++x) {
            const bool isPlate = x < with.width / 2 && y > with.height * 2 / 3;
            EXPECT_TRUE(isPlate || with.rgb(x, y) == without.rgb(x, y)) << x << ", " << y;
            longest = std::max(longest, whiteFrom(with, x, y));
        }
    }
    EXPECT_EQ(longest, 60); // 5 mm at 3 pixels, 4 times
    expectRefusal(render("new.exr", {"--scale-bar"}), 2, "radiance");
    expectRefusal(render("new.png", {"--scale-bar"}), 2, "60x40");
    scene_.surface.pixelsPerMillimetre.reset();
    saveSurface(folder_ / "s.nacre", scene_.surface, true);
    expectRefusal(render("new.png", {"--scale", "4", "--scale-bar"}), 2, "--pixels-per-mm");
    for (const double pixels : {0.0013, 0.7, 4.0, 4.01, 36.4, 2500.0}) {
        const double millimetres = scaleBarLength(1000, pixels),
                     decade = std::pow(10, std::floor(std::log10(millimetres) + 1e-9));
        EXPECT_LE(millimetres * pixels, 250 + 1e-9);
        EXPECT_GT(millimetres * pixels, 250 / 2.5 - 1e-9);
        const double first = millimetres / decade;
        EXPECT_LT(std::min({std::abs(first - 1), std::abs(first - 2), std::abs(first - 5)}), 1e-9) << millimetres;
    }
}

TEST_F(RenderTest, SizesComeFromTheCapture)
{
    const std::string capture = makeSmallCapture(folder_);
    ASSERT_EQ(runNacre({"acquire", capture, "--pixels-per-mm", "12", "--shrink", "2", "--normals", "least-squares",
                        "-o", path("sized.nacre")})
                  .exitCode,
              0);
    EXPECT_EQ(loadSurface(path("sized.nacre")).pixelsPerMillimetre, 6);
    EXPECT_NE(runNacre({"info", path("sized.nacre")}).out.find("6 pixels a millimetre"), std::string::npos);
    expectOneLine(runNacre({"acquire", capture, "--pixels-per-mm", "0", "-o", path("new.nacre")}), 2, {"above 0"});
}

TEST_F(RenderTest, ABlackEnvironmentIsABlackPicture)
{
    saveImage(folder_ / "black.exr", Image(16, 8, 3), PixelType::float32);
    ASSERT_EQ(render("new.exr", {"--environment", path("black.exr")}).exitCode, 0);
    for (const float value : loadImage(path("new.exr")).values) {
        ASSERT_EQ(value, 0);
    }
}

} // namespace
} // namespace nacre::test
