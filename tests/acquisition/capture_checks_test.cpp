// What is checked alike for every layout: counts, sizes, masks, curves, exposure times, rigs.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "acquisition/capture/capture.h"
#include "acquisition/capture/capture_maps.h"
#include "engine/lights/light_files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/support/write_capture.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

class CaptureChecks : public testing::Test {
protected:
    CaptureChecks() { writeUwFolder(folder_.path(), "cat", 4, ".png"); }
    Capture load() { return loadCapture(folder_.path(), options_); }
    void expectRefused(const std::vector<std::string>& fragments)
    {
        expectError([&] { load(); }, fragments);
    }
    void writeExposed(int number, const char* seconds)
    {
        saveImage(folder_ / ("cat." + std::to_string(number) + ".png"), testPicture(number), PixelType::uint16,
                  {{"ExposureTime", seconds}});
    }
    TempFolder folder_;
    CaptureOptions options_;
};

TEST_F(CaptureChecks, MissingFolder)
{
    expectError([&] { loadCapture(folder_ / "nowhere"); }, {"nowhere", "does not exist"});
    expectError([&] { loadCapture(folder_ / "cat.0.png"); }, {"cat.0.png", "is no folder"});
}

TEST_F(CaptureChecks, AFolderWithoutCaptureSaysWhatWasLookedFor)
{
    writeText(folder_ / "empty" / "holiday.doc", "");
    expectError([&] { loadCapture(folder_ / "empty"); },
                {"empty", "holds no capture", "capture.json", "filenames.txt", ".lp", "NAME.0.*", "NAME.mask.*"});
    writePicture(folder_ / "empty" / "holiday.jpg", 1);
    expectError([&] { loadCapture(folder_ / "empty"); }, {"empty", "1 photographs", "at least 3"});
}

TEST_F(CaptureChecks, FewerThanThreePhotographs)
{
    fs::remove(folder_ / "cat.0.png");
    EXPECT_EQ(load().photographs.size(), 3u);
    fs::remove(folder_ / "cat.1.png");
    expectRefused({folder_.path().string(), "2 photographs", "at least 3"});
}

TEST_F(CaptureChecks, UnreadablePhotograph)
{
    writeText(folder_ / "cat.2.png", "this is no picture");
    expectRefused({"cat.2.png", "cannot be read"});
}

// Loading a capture of many large photographs has to be quick.
TEST_F(CaptureChecks, HeadersAloneAreRead)
{
    for (int i = 0; i < 4; ++i) {
        const fs::path file = folder_ / ("cat." + std::to_string(i) + ".png");
        writePicture(file, testPicture(i, 300, 300));
        fs::resize_file(file, fs::file_size(file) / 2);
    }
    writeMask(folder_ / "cat.mask.tga", 1, 300, 300);
    EXPECT_EQ(load().width, 300);
}

// The camera stood still.
TEST_F(CaptureChecks, OneOrientation)
{
    const auto turn = [&](int number) {
        saveImage(folder_ / ("cat." + std::to_string(number) + ".png"), testPicture(number), PixelType::uint16,
                  {{"Orientation", "3"}});
    };
    turn(2);
    expectRefused({"cat.2.png", "EXIF orientation 3", "cat.0.png by 1", "one orientation in all files"});
    for (const int number : {0, 1, 3}) {
        turn(number);
    }
    EXPECT_EQ(load().photographs.size(), 4u);
}

TEST_F(CaptureChecks, OutlineWindowAndAmbientMayBeOptions)
{
    writeUwFolder(folder_ / "chrome", "chrome", 4, ".png");
    fs::remove(folder_ / "chrome" / "chrome.mask.tga");
    options_.mirrorSphere = folder_ / "chrome";
    expectRefused({"chrome", "0 masks of a sphere", "--circle"});
    options_.circle = Circle{3, 3, 2};
    options_.window = {2, 1, 4, 4, 2};
    options_.ambient = folder_ / "chrome" / "chrome.0.png";
    const Capture capture = load();
    EXPECT_EQ(capture.mirrorSphere->circle->radius, 2);
    EXPECT_EQ(capture.width, 2);
    EXPECT_EQ(capture.ambient->name, "chrome.0.png");
}

TEST_F(CaptureChecks, AMaskOnItsSideIsToldSo)
{
    writeMask(folder_ / "cat.mask.tga", 2, kTestHeight, kTestWidth);
    expectRefused({"cat.mask.tga", "turned on its side"});
}

TEST_F(CaptureChecks, PhotographOfAnotherSize)
{
    writePicture(folder_ / "cat.2.png", testPicture(2, 9, 6));
    expectRefused({"cat.2.png", "9 x 6", "8 x 6", "cat.0.png"});
}

TEST_F(CaptureChecks, MaskOfAnotherSizeOrEmpty)
{
    writeMask(folder_ / "cat.mask.tga", 1, 6, 8);
    expectRefused({"cat.mask.tga", "6 x 8", "8 x 6"});
    writeMask(folder_ / "cat.mask.tga", kTestWidth);
    expectRefused({"cat.mask.tga", "empty mask"});
    writeText(folder_ / "cat.mask.tga", "");
    expectRefused({"cat.mask.tga"});
}

TEST_F(CaptureChecks, MaskIsTheBrightestChannelAboveOneHalf)
{
    Image mask(3, 1, 4, 1.0f); // alpha does not count
    const float greens[] = {0.49f, 0.51f, 0};
    for (int x = 0; x < 3; ++x) {
        mask.setRgb(x, 0, {0, greens[x], 0});
    }
    writePicture(folder_ / "mask.tif", mask);
    EXPECT_EQ(loadMask(folder_ / "mask.tif", 0, 0).inside, (std::vector<uint8_t>{0, 1, 0}));
}

TEST_F(CaptureChecks, MaskOptionComesBeforeTheFolders)
{
    writeMask(folder_ / "other" / "half.png", 4);
    options_.mask = folder_ / "other" / "half.png";
    EXPECT_EQ(load().maskPixels, size_t{4} * kTestHeight);
    options_.mask = folder_ / "nothing.png";
    expectRefused({"nothing.png"});
}

TEST_F(CaptureChecks, TransferCurveByPrecedence)
{
    // 16-bit pictures of the project's own say that they are linear.
    EXPECT_EQ(load().curve, TransferCurve::linear);
    EXPECT_EQ(load().curveSource, "declared by cat.0.png");
    for (int i = 0; i < 4; ++i) { // 8-bit ones say sRGB
        saveImage(folder_ / ("cat." + std::to_string(i) + ".png"), testPicture(i), PixelType::uint8);
    }
    EXPECT_EQ(load().curve, TransferCurve::srgb);
    EXPECT_EQ(load().curveSource, "declared by cat.0.png");
    options_.transfer = TransferCurve::linear;
    EXPECT_EQ(load().curve, TransferCurve::linear);
    EXPECT_EQ(load().curveSource, "chosen");
}

TEST_F(CaptureChecks, PhotographsThatDeclareDifferentCurves)
{
    saveImage(folder_ / "cat.2.png", testPicture(2), PixelType::uint8);
    expectRefused({"cat.2.png", "declares sRGB", "cat.0.png", "declares linear", "one curve"});
    options_.transfer = TransferCurve::linear;
    EXPECT_EQ(load().curve, TransferCurve::linear);
}

TEST_F(CaptureChecks, SpherePhotographsShareTheCurve)
{
    for (int i = 0; i < 4; ++i) {
        fs::create_directories(folder_ / "chrome");
        saveImage(folder_ / "chrome" / ("c." + std::to_string(i) + ".png"), testPicture(i), PixelType::uint8);
    }
    writeMask(folder_ / "chrome" / "c.mask.png");
    options_.mirrorSphere = folder_ / "chrome";
    expectRefused({"c.0.png", "declares sRGB", "cat.0.png"});
}

TEST_F(CaptureChecks, ExifTimesCountWhereTheyDiffer)
{
    for (int i = 0; i < 4; ++i) {
        writeExposed(i, i == 2 ? "0.125" : "0.5");
    }
    const Capture capture = load();
    EXPECT_EQ(capture.photographs[0].exposures[0].seconds, 1.0);
    EXPECT_EQ(capture.photographs[2].exposures[0].seconds, 0.25);
}

TEST_F(CaptureChecks, ExifTimesThatAreEqualDoNotCount)
{
    for (int i = 0; i < 4; ++i) {
        writeExposed(i, "0.5");
    }
    EXPECT_EQ(load().photographs[1].exposures[0].seconds, 1.0);
    writePicture(folder_ / "cat.0.png", 0); // nor where some are missing
    EXPECT_EQ(load().photographs[1].exposures[0].seconds, 1.0);
}

TEST_F(CaptureChecks, ExifTimesThatDifferAndAreMissingElsewhere)
{
    writeExposed(1, "0.5");
    writeExposed(3, "0.25");
    expectRefused({"cat.0.png", "no exposure time", "cat.3.png", "0.25"});
}

TEST_F(CaptureChecks, GivenTimesComeBeforeExif)
{
    for (int i = 0; i < 4; ++i) {
        writeExposed(i, i == 2 ? "0.125" : "0.5");
    }
    writeText(folder_ / "capture.json", R"({"format": "nacre capture", "version": 1, "photographs": [
        {"file": "cat.0.png", "exposureSeconds": 3}, {"file": "cat.1.png", "exposureSeconds": 3},
        {"file": "cat.2.png", "exposureSeconds": 3}]})");
    EXPECT_EQ(load().photographs[2].exposures[0].seconds, 3.0);
}

// A picture of 4 by 3 has 4/5 of its diagonal as its width; that of film is 43.27 mm.
TEST_F(CaptureChecks, AFocalLengthOfFilmStatesAView)
{
    const Image picture(8, 6, 3);
    Image mask(8, 6, 1);
    std::fill(mask.values.begin(), mask.values.end(), 1.0f);
    fs::remove(folder_ / "cat.mask.tga");
    writePicture(folder_ / "cat.mask.png", mask);
    const auto writeAll = [&](const char* ofTheLast) {
        for (int i = 0; i < 4; ++i) {
            saveImage(folder_ / ("cat." + std::to_string(i) + ".png"), picture, PixelType::uint16,
                      {{"Exif:FocalLengthIn35mmFilm", i == 3 ? ofTheLast : "75"}});
        }
    };
    writeAll("75");
    ASSERT_TRUE(load().viewByExif);
    EXPECT_NEAR(*load().viewByExif, 2 * std::atan(0.8 * 43.2666 / 2 / 75) * 180 / M_PI, 1e-4);
    EXPECT_FALSE(load().fieldOfView) << "stated, not used";
    writeAll("50");
    EXPECT_FALSE(load().viewByExif) << "a zoom that was moved";
    writeAll("0");
    EXPECT_FALSE(load().viewByExif);
}

TEST_F(CaptureChecks, RigTableInOrder)
{
    writeText(folder_ / "rig.txt", "4\n" + directionLines(4));
    options_.rig = folder_ / "rig.txt";
    const Capture capture = load();
    ASSERT_EQ(capture.lights.size(), 4u);
    EXPECT_NEAR(capture.lights[0].direction.x, 0.5f, 1e-6f);
    EXPECT_FALSE(capture.irradianceGiven);
    EXPECT_EQ(capture.lightsSource, (folder_ / "rig.txt").string());
    writeText(folder_ / "rig.txt", directionLines(5));
    expectRefused({"rig.txt", "5 lights", folder_.path().string(), "4 photographs"});
}

class CaptureRig : public CaptureChecks {
protected:
    void writeRig(const std::vector<std::string>& names)
    {
        LightFile rig;
        rig.photographs = names;
        for (size_t i = 0; i < names.size(); ++i) {
            rig.lights.push_back({{0, 0, 1}, glm::vec3(1.0f + static_cast<float>(i))});
        }
        rig.irradianceGiven = true;
        saveLightFile(folder_ / "rig.json", rig);
        options_.rig = folder_ / "rig.json";
    }
};

TEST_F(CaptureRig, FollowsTheNamesOfPhotographs)
{
    writeRig({"x/cat.3.png", "cat.2.jpg", "D:\\y\\cat.1.png", "cat.0.png"});
    const Capture capture = load();
    EXPECT_TRUE(capture.irradianceGiven);
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(capture.lights[i].irradiance, glm::vec3(4.0f - static_cast<float>(i)));
    }
}

TEST_F(CaptureRig, OfAnotherObjectCountsInOrder)
{
    writeRig({"dog.3.png", "dog.2.png", "dog.1.png", "dog.0.png"});
    EXPECT_EQ(load().lights[3].irradiance, glm::vec3(4));
}

TEST_F(CaptureRig, ThatNamesSomePhotographsIsRefused)
{
    writeRig({"cat.0.png", "cat.1.png", "cat.2.png", "cat.4.png"});
    expectRefused({"rig.json", "3 of 4 photographs", "cat.3.png"});
}

TEST_F(CaptureRig, WhoseNamesRepeatCountsInOrder)
{
    writeRig({"a/cat.3.png", "b/cat.3.png", "a/cat.1.png", "b/cat.1.png"});
    EXPECT_EQ(load().lights[3].irradiance, glm::vec3(4));
    // The same file name in two folders of the capture.
    writePicture(folder_ / "other" / "cat.0.png", 5);
    writeText(folder_ / "capture.json", R"({"format": "nacre capture", "version": 1,
        "photographs": ["cat.0.png", "other/cat.0.png", "cat.1.png", "cat.2.png"]})");
    writeRig({"cat.2.png", "cat.1.png", "x.png", "cat.0.png"});
    EXPECT_EQ(load().lights[3].irradiance, glm::vec3(4));
}

TEST_F(CaptureRig, TakesThePlaceOfTheFoldersLights)
{
    writeDiligentFolder(folder_ / "d", 4);
    writeRig({"a", "b", "c", "d"});
    EXPECT_EQ(loadCapture(folder_ / "d", options_).lights[1].irradiance, glm::vec3(2));
}

} // namespace
} // namespace nacre
