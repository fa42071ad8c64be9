#include <gtest/gtest.h>

#include "acquisition/capture/capture.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/support/write_capture.h"

namespace nacre {
namespace {

class CaptureJson : public testing::Test {
protected:
    CaptureJson()
    {
        for (int i = 1; i <= 3; ++i) {
            writePicture(folder_ / ("p" + std::to_string(i) + ".png"), i);
            writePicture(folder_ / "sphere" / (std::to_string(i) + ".png"), testPicture(i, 5, 5));
        }
        writeMask(folder_ / "mask.png");
        writeText(folder_ / "lights.txt", directionLines(3));
    }
    // `rest` follows "photographs" after a comma.
    Capture load(const std::string& photographs, const std::string& rest = "")
    {
        writeText(folder_ / "capture.json", R"({"format": "nacre capture", "version": 1, "photographs": )" +
                                                photographs + (rest.empty() ? "" : ", " + rest) + "}");
        return loadCapture(folder_.path());
    }
    void expectRefused(const std::string& photographs, const std::string& rest, std::vector<std::string> fragments)
    {
        fragments.emplace_back("capture.json");
        expectError([&] { load(photographs, rest); }, fragments);
    }
    TempFolder folder_;
    const std::string files_ = R"(["p1.png", {"file": "p2.png"}, "p3.png"])";
};

TEST_F(CaptureJson, OnlyPhotographsAreNeeded)
{
    const Capture capture = load(files_);
    EXPECT_EQ(capture.layout, CaptureLayout::json);
    EXPECT_EQ(capture.name, folder_.path().filename());
    ASSERT_EQ(capture.photographs.size(), 3u);
    EXPECT_EQ(capture.photographs[1].exposures[0].file, folder_ / "p2.png");
    EXPECT_TRUE(capture.lights.empty());
    EXPECT_EQ(capture.maskPixels, size_t{kTestWidth} * kTestHeight);
}

TEST_F(CaptureJson, EverythingAtOnce)
{
    writeText(folder_ / "truth" / "n.exr", "");
    const Capture capture = load(
        R"([{"file": "p1.png", "exposureSeconds": 0.5, "light": {"direction": [0, 0, 2], "irradiance": [1, 2, 3]}},
            {"exposures": [{"file": "p2.png", "seconds": 2}, {"file": "p3.png", "seconds": 0.25}],
             "light": {"direction": [3, 0, 4], "irradiance": [1, 1, 1]}},
            {"file": "p3.png", "exposureSeconds": 1, "light": {"direction": [0, 1, 0], "irradiance": [1, 1, 1]}}])",
        R"("name": "thing", "transfer": "srgb", "mask": "mask.png", "truthNormals": "truth/n.exr",
           "mirrorSphere": {"photographs": ["sphere/1.png", "sphere/2.png", "sphere/3.png"], "circle": [2.5, 2, 1.5]},
           "diffuseSphere": {"photographs": [{"file": "sphere/1.png", "exposureSeconds": 2}, {"file": "sphere/2.png",
             "exposureSeconds": 2}, {"exposures": [{"file": "sphere/3.png", "seconds": 4}]}], "circle": [2.5, 2, 1]})");
    EXPECT_EQ(capture.name, "thing");
    EXPECT_EQ(capture.curve, TransferCurve::srgb);
    EXPECT_EQ(capture.curveSource, "capture.json");
    EXPECT_EQ(capture.photographs[0].exposures[0].seconds, 0.5);
    EXPECT_EQ(capture.photographs[1].name, "p2.png");
    ASSERT_EQ(capture.photographs[1].exposures.size(), 2u);
    EXPECT_EQ(capture.photographs[1].exposures[1].seconds, 0.25);
    EXPECT_EQ(capture.lights[0].direction, glm::vec3(0, 0, 1));
    EXPECT_EQ(capture.lights[0].irradiance, glm::vec3(1, 2, 3));
    EXPECT_TRUE(capture.irradianceGiven);
    EXPECT_EQ(capture.truthNormals, folder_ / "truth" / "n.exr");
    ASSERT_TRUE(capture.mirrorSphere && capture.mirrorSphere->circle && capture.diffuseSphere);
    EXPECT_EQ(capture.mirrorSphere->circle->x, 2.5);
    EXPECT_EQ(capture.mirrorSphere->circle->radius, 1.5);
    EXPECT_EQ(capture.diffuseSphere->photographs[2].exposures[0].seconds, 4.0);
}

TEST_F(CaptureJson, LightsFromFiles)
{
    writeText(folder_ / "power.txt", "1\n2\n4\n");
    const Capture capture = load(files_, R"("lights": "lights.txt", "irradiances": "power.txt")");
    ASSERT_EQ(capture.lights.size(), 3u);
    EXPECT_EQ(capture.lights[2].irradiance, glm::vec3(4));
    EXPECT_TRUE(capture.irradianceGiven);
    EXPECT_EQ(capture.lightsSource, (folder_ / "lights.txt").string());
    EXPECT_FALSE(load(files_, R"("lights": "lights.txt")").irradianceGiven);
}

TEST_F(CaptureJson, PathsMayBeAbsoluteAndElsewhere)
{
    const TempFolder other;
    const std::string base = folder_.path().string() + "/";
    writeText(other / "capture.json", R"({"format": "nacre capture", "version": 1, "photographs": [")" + base +
                                          R"(p1.png", ")" + base + R"(p2.png", "../)" +
                                          folder_.path().filename().string() + R"(/p3.png"]})");
    EXPECT_EQ(loadCapture(other.path()).photographs.size(), 3u);
}

TEST_F(CaptureJson, ComesBeforeOtherLayouts)
{
    writeDiligentFolder(folder_.path(), 4);
    EXPECT_EQ(load(files_).layout, CaptureLayout::json);
}

TEST_F(CaptureJson, UnknownKeysAreRefusedByName)
{
    expectRefused(files_, R"("masks": "mask.png")", {"unknown key \"masks\""});
    expectRefused(R"(["p1.png", {"file": "p2.png", "exposure": 1}])", "", {"photographs[1]", "\"exposure\""});
    expectRefused(R"([{"exposures": [{"file": "p1.png", "seconds": 1, "iso": 100}]}])", "",
                  {"photographs[0].exposures[0]", "\"iso\""});
    expectRefused(R"([{"file": "p1.png", "light": {"direction": [0,0,1], "color": 1}}])", "",
                  {"photographs[0].light", "\"color\""});
    expectRefused(files_, R"("mirrorSphere": {"photographs": [{"file": "p1.png", "light": 1}], "circle": [1,1,1]})",
                  {"mirrorSphere.photographs[0]", "\"light\""});
    expectRefused(files_, R"("mirrorSphere": {"photographs": [], "radius": 1})", {"mirrorSphere", "\"radius\""});
}

TEST_F(CaptureJson, WrongTypesAreNamedWithTheirPlace)
{
    expectRefused("1", "", {"photographs is a number", "array"});
    expectRefused("[1]", "", {"photographs[0] is a number", "object"});
    expectRefused(R"([{"file": 1}])", "", {"photographs[0].file is a number", "string"});
    expectRefused(R"([{"file": "p1.png", "exposureSeconds": "1"}])", "",
                  {"photographs[0].exposureSeconds is a string"});
    expectRefused(R"([{"file": "p1.png", "light": {"direction": [0, "1", 0]}}])", "",
                  {"photographs[0].light.direction[1] is a string"});
    expectRefused(R"([{"file": "p1.png", "light": {"direction": [0, 1]}}])", "",
                  {"photographs[0].light.direction has 2 numbers", "3 numbers"});
    expectRefused(files_, R"("name": ["x"])", {"name is an array"});
    expectRefused(files_, R"("mirrorSphere": {"photographs": ["p1.png"], "circle": [1, 1]})", {"mirrorSphere.circle"});
}

TEST_F(CaptureJson, WrongValuesAreNamedWithTheirPlace)
{
    expectRefused(files_, R"("transfer": "gamma")", {"transfer is \"gamma\"", "linear"});
    expectRefused(R"([{"file": "p1.png", "exposureSeconds": 0}])", "", {"photographs[0].exposureSeconds is 0"});
    expectRefused(R"([{"file": "p1.png", "light": {"direction": [0, 0, 0]}}])", "", {"photographs[0].light.direction"});
    expectRefused(R"([{"file": "p1.png", "light": {"direction": [0, 0, 1], "irradiance": [1, 1, -1]}}])", "",
                  {"photographs[0].light.irradiance"});
    expectRefused(R"([{"exposures": []}])", "", {"photographs[0].exposures is empty"});
    expectRefused(R"([{"exposures": [{"file": "p1.png", "seconds": 1}], "file": "p1.png"}])", "", {"photographs[0]"});
    expectRefused(R"(["nothing.png"])", "", {"photographs[0]", "nothing.png", "does not exist"});
    expectRefused(files_, R"("mask": "nothing.png")", {"mask", "nothing.png"});
    expectRefused(files_, R"("truthNormals": "nothing.exr")", {"truthNormals", "nothing.exr"});
    expectRefused(files_, R"("mirrorSphere": {"photographs": ["p1.png"], "circle": [1, 1, 0]})", {"radius 0"});
    expectRefused(files_, R"("mirrorSphere": {"photographs": ["p1.png"]})", {"neither mask nor circle"});
    expectRefused(files_, R"("mirrorSphere": {"photographs": ["p1.png"], "circle": [1, 1, 1], "mask": "mask.png"})",
                  {"a mask and a circle"});
}

TEST_F(CaptureJson, VersionsAndFormatsThatAreUnknownAreRefused)
{
    const auto refuse = [&](const std::string& text, const std::vector<std::string>& fragments) {
        writeText(folder_ / "capture.json", text);
        expectError([&] { loadCapture(folder_.path()); }, fragments);
    };
    refuse(R"({"format": "nacre capture", "version": 2, "photographs": []})", {"capture.json", "version is 2"});
    refuse(R"({"format": "nacre capture", "version": 0, "photographs": []})", {"version is 0"});
    refuse(R"({"format": "nacre capture", "photographs": []})", {"lacks \"version\""});
    refuse(R"({"format": "nacre lights", "version": 1})", {"format is \"nacre lights\""});
    refuse(R"({"format": "nacre capture", "version": 1})", {"lacks \"photographs\""});
    refuse(R"({"format": "nacre capture",)", {"capture.json", "is not JSON", "line 1"});
    refuse("[]", {"is an array"});
}

TEST_F(CaptureJson, LightsAndTimesForAllOrForNone)
{
    const std::string light = R"("light": {"direction": [0, 0, 1]})";
    const std::string bright = R"("light": {"direction": [0, 0, 1], "irradiance": [1, 1, 1]})";
    const std::string time = R"("exposureSeconds": 1)";
    expectRefused(R"([{"file": "p1.png", )" + light + R"(}, {"file": "p2.png"}])", "",
                  {"photographs[1] lacks a light"});
    expectRefused(R"(["p1.png", {"file": "p2.png", )" + light + "}]", "", {"photographs[1] has a light"});
    expectRefused(R"([{"file": "p1.png", )" + light + R"(}, {"file": "p2.png", )" + bright + "}]", "",
                  {"photographs[1].light has an irradiance"});
    expectRefused(R"([{"file": "p1.png", )" + time + R"(}, {"file": "p2.png"}])", "",
                  {"photographs[1] lacks an exposure"});
}

TEST_F(CaptureJson, LightsFromOneSourceAlone)
{
    const std::string lit = R"([{"file": "p1.png", "light": {"direction": [0, 0, 1], "irradiance": [1, 1, 1]}}])";
    expectRefused(lit, R"("lights": "lights.txt")", {"lights comes beside"});
    expectRefused(lit, R"("irradiances": "lights.txt")", {"irradiances comes beside"});
    expectRefused(files_, R"("irradiances": "lights.txt")", {"irradiances comes without directions"});
}

TEST_F(CaptureJson, CountsHaveToAgree)
{
    writeText(folder_ / "lights.txt", directionLines(4));
    expectRefused(files_, R"("lights": "lights.txt")", {"lights.txt", "4 lights", "3 photographs"});
    writeText(folder_ / "lights.txt", directionLines(3));
    writeText(folder_ / "power.txt", "1\n2\n");
    expectError([&] { load(files_, R"("lights": "lights.txt", "irradiances": "power.txt")"); },
                {"power.txt", "2 lights", "3"});
    expectRefused(files_, R"("mirrorSphere": {"photographs": ["sphere/1.png"], "circle": [1, 1, 1]})",
                  {"1 photographs of a sphere", "3 of the object"});
}

} // namespace
} // namespace nacre
