#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/capture/capture.h"
#include "acquisition/lights/lights.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/support/write_capture.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

constexpr float kUnitTolerance = 1e-6f;

class CaptureRti : public testing::Test {
protected:
    CaptureRti() { writeRtiFolder(folder_.path(), 10); }
    Capture load(const CaptureOptions& options = {}) { return loadCapture(folder_.path(), options); }
    void expectRefused(const std::vector<std::string>& fragments)
    {
        expectError([&] { load(); }, fragments);
    }
    TempFolder folder_;
};

TEST_F(CaptureRti, StaleFoldersAndSpacesInNames)
{
    const Capture capture = load();
    EXPECT_EQ(capture.layout, CaptureLayout::rti);
    ASSERT_EQ(capture.photographs.size(), 10u);
    EXPECT_EQ(capture.photographs[9].name, "photo 10.png");
    EXPECT_EQ(capture.photographs[9].exposures[0].file, folder_ / "photo 10.png");
    EXPECT_NEAR(glm::length(capture.lights[9].direction), 1, kUnitTolerance);
    EXPECT_NEAR(capture.lights[9].direction.x, 1 / std::sqrt(1 + 0.25f + 4), kUnitTolerance);
    EXPECT_FALSE(capture.irradianceGiven);
    EXPECT_EQ(capture.lightsSource, (folder_ / "lights.lp").string());
    EXPECT_EQ(capture.maskPixels, size_t{kTestWidth} * kTestHeight);
}

TEST_F(CaptureRti, AListIsACaptureByItself)
{
    writeText(folder_ / "b.lp", "3\nphoto 3.png 1 0 0\nphoto 2.png 0 1 0\nphoto 1.png 0 0 1\n");
    const Capture capture = loadCapture(folder_ / "b.lp");
    EXPECT_EQ(capture.photographs[0].name, "photo 3.png");
    EXPECT_EQ(capture.name, folder_.path().filename());
    expectError([&] { loadCapture(folder_ / "photo 1.png"); }, {"photo 1.png: is no folder", ".lp"});
}

TEST_F(CaptureRti, AFourthNumberIsAnIrradiance)
{
    writeText(folder_ / "lights.lp", "photo 3.png 1 0 0 2\nphoto 2.png 0 1 0 0.5\nphoto 1.png 0 0 1 1\n");
    const Capture capture = load();
    EXPECT_TRUE(capture.irradianceGiven);
    EXPECT_EQ(capture.lights[0].direction, glm::vec3(1, 0, 0));
    EXPECT_EQ(capture.lights[1].irradiance, glm::vec3(0.5f));
    writeText(folder_ / "lights.lp", "photo 3.png 1 0 0 2\nphoto 2.png 0 1 0\nphoto 1.png 0 0 1 1\n");
    expectRefused({"lights.lp", "fourth number of photo 2.png is missing", "for all photographs or for none"});
    writeText(folder_ / "lights.lp", "photo 3.png 1 0 0 0\nphoto 2.png 0 1 0 1\nphoto 1.png 0 0 1 1\n");
    expectRefused({"lights.lp", "fourth number of photo 3.png is 0", "above 0"});
}

TEST_F(CaptureRti, LightsFollowNamesAndNotTheOrderOfFiles)
{
    writeText(folder_ / "lights.lp", "3\nphoto 10.png 1 0 0\n/old/photo 2.png 0 1 0\nphoto 9.png 0 0 1\n");
    const Capture capture = load();
    EXPECT_EQ(capture.photographs[0].name, "photo 10.png");
    EXPECT_EQ(capture.lights[0].direction, glm::vec3(1, 0, 0));
    EXPECT_EQ(capture.photographs[1].name, "photo 2.png");
}

TEST_F(CaptureRti, OtherExtensionsAndCaseAreFoundByStem)
{
    for (int i = 1; i <= 10; ++i) {
        fs::rename(folder_ / ("photo " + std::to_string(i) + ".png"),
                   folder_ / ("Photo " + std::to_string(i) + ".PNG"));
    }
    EXPECT_EQ(load().photographs[3].name, "Photo 4.PNG");
    fs::remove(folder_ / "Photo 4.PNG");
    writePicture(folder_ / "PHOTO 4.tif", 4);
    EXPECT_EQ(load().photographs[3].name, "PHOTO 4.tif");
}

TEST_F(CaptureRti, HiddenFilesAndFoldersThatCannotBeReadStopNobody)
{
    writeText(folder_ / "._lights.lp", std::string("\0\5\26\7", 4));
    fs::create_directory(folder_ / "lost+found");
    fs::permissions(folder_ / "lost+found", fs::perms::none);
    EXPECT_EQ(load().photographs.size(), 10u);
    fs::permissions(folder_ / "lost+found", fs::perms::owner_all);
}

// The same name in both Unicode forms, the list in every encoding that people have.
TEST_F(CaptureRti, NamesAndListsInAnyEncoding)
{
    const std::string composed = "M\xc3\xbcnze", decomposed = "Mu\xcc\x88nze";
    for (int i = 1; i <= 3; ++i) {
        writePicture(folder_ / (decomposed + std::to_string(i) + ".png"), i);
    }
    const auto lines = [](const std::string& name) {
        return "3\n" + name + "1.png 1 0 1\n" + name + "2.png 0 1 1\n" + name + "3.png 0 0 1\n";
    };
    std::string wide = "\xff\xfe";
    for (const char c : lines("M\xfcnze")) { // Latin-1 is UTF-16's beginning
        wide += std::string{c, '\0'};
    }
    for (const std::string& text : {lines(composed), lines(decomposed), "\xef\xbb\xbf" + lines(composed), wide,
                                    wide.substr(2), lines("M\xfcnze"), lines("M\xc3\x9cNZE")}) {
        writeText(folder_ / "lights.lp", text);
        const Capture capture = load();
        ASSERT_EQ(capture.photographs.size(), 3u);
        EXPECT_EQ(capture.photographs[1].name, decomposed + "2.png");
    }
}

TEST_F(CaptureRti, OfSeveralFoldersTheOneThatTheListNames)
{
    const fs::path rti = folder_ / "rti"; // without photographs of its own
    std::string list = "3\n";
    for (int i = 1; i <= 3; ++i) {
        const std::string name = "shot" + std::to_string(i) + ".png";
        for (const char* below : {"cropped-files", "jpeg-exports"}) {
            fs::create_directories(rti / below);
            writePicture(rti / below / name, i);
        }
        list += "C:\\my rti\\jpeg-exports\\" + name + " 1 0 " + std::to_string(i) + "\n";
    }
    writeText(rti / "lights.lp", list);
    EXPECT_EQ(loadCapture(rti).photographs[2].exposures[0].file, rti / "jpeg-exports/shot3.png");
}

TEST(CapturePictures, AnyFolderWithARig)
{
    const TempFolder folder;
    std::string rig = "3\n";
    for (int i : {1, 2, 10}) {
        writePicture(folder / ("c/DSC_" + std::to_string(i) + ".png"), i);
        rig += "dome" + std::to_string(i) + ".png 0 " + std::to_string(i) + " 1\n";
    }
    writeText(folder / "rig.lp", rig);
    EXPECT_TRUE(loadCapture(folder / "c").lights.empty());
    CaptureOptions options;
    options.rig = folder / "rig.lp";
    const Capture capture = loadCapture(folder / "c", options);
    EXPECT_EQ(capture.layout, CaptureLayout::pictures);
    EXPECT_EQ(capture.photographs[2].name, "DSC_10.png");
    EXPECT_GT(capture.lights[2].direction.y, capture.lights[1].direction.y);
}

class CaptureLists : public testing::Test {
protected:
    void writePhotographs(const std::vector<std::string>& names)
    {
        for (const std::string& name : names) {
            writePicture(folder_ / name, static_cast<int>(&name - names.data()) + 1);
        }
    }
    Capture load()
    {
        CaptureOptions options;
        options.needsLights = true;
        return loadCapture(folder_.path(), options);
    }
    TempFolder folder_;
};

TEST_F(CaptureLists, BesideThePhotographs)
{
    writePhotographs({"a1.png", "a2.png", "a10.png"});
    writeText(folder_ / "points.txt", "1 2 3\n4 5 6\n");
    writeText(folder_ / "notes.txt", "three lights\n");
    writeText(folder_ / "lightvec.txt", "0 0 1\n3 0 4\n0 3 4\n");
    writeText(folder_ / "intensities.txt", "1\n2\n3\n");
    const Capture capture = load();
    EXPECT_EQ(capture.layout, CaptureLayout::pictures);
    EXPECT_EQ(capture.lightsSource, (folder_ / "lightvec.txt").string());
    EXPECT_NEAR(capture.lights[2].direction.y, 0.6f, 1e-6f); // of a10.png
    EXPECT_TRUE(capture.irradianceGiven);
    EXPECT_EQ(capture.lights[2].irradiance.x, 3);
    writeText(folder_ / "others.csv", "0,0,1\n3,0,4\n0,3,4\n");
    expectError([&] { load(); }, {"several lists of 3 lights", "lightvec.txt", "others.csv", "--rig"});
}

// Each states the direction (0.6, 0, 0.8) of its second photograph.
TEST_F(CaptureLists, DirectionsInNames)
{
    const std::vector<std::string> notations[] = {
        {"Sphere_0.0_0.0_1.0.png", "Sphere_0.6_0.0_0.8.png", "Sphere_-0.6_0.0_0.8.png"},
        {"tl000_pl000.png", "tl36.87_pl000.png", "tl36.87_pl180.png"},
        {"yaleB01_P00A+000E+00.png", "yaleB01_P00A+037E+00.png", "yaleB01_P00A-037E+00.png"}};
    for (const auto& names : notations) {
        fs::remove_all(folder_.path());
        writePhotographs(names);
        for (const Capture& capture : {load()}) {
            for (size_t i = 0; i < 3; ++i) {
                const bool isTurned = capture.photographs[i].name == names[1];
                EXPECT_EQ(capture.lights[i].direction.x > 0.5f, isTurned) << capture.photographs[i].name;
                EXPECT_NEAR(capture.lights[i].direction.y, 0, 1e-6f);
            }
        }
    }
}

// Two numbers may be coordinates or angles of several kinds: nobody guesses.
TEST_F(CaptureLists, AreMissedInThreeLines)
{
    writePhotographs({"Sphere_-0.5_1.0.png", "Sphere_-0.5_1.5.png", "Sphere_0.5_1.0.png", "wide.jpg"});
    writeMask(folder_ / "mask.png");
    writeText(folder_ / "lights.npy", "\x93NUMPY");
    writeText(folder_ / "lights.txt", "0 0 1\n0 1 1\n");
    try {
        load();
        ADD_FAILURE();
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 2) << message;
        for (const char* part : {"1 .jpg of 8x6, 3 .png of 8x6", "mask.png", "lights.txt with 2 lights", "lights.npy",
                                 "--rig", "--mirror-sphere", ".lp"}) {
            EXPECT_NE(message.find(part), std::string::npos) << part << " is not in: " << message;
        }
    }
}

TEST_F(CaptureRti, MasksMayLieInAlpha)
{
    Image mask(kTestWidth, kTestHeight, 4, 1.0f);
    for (int x = 0; x < kTestWidth; ++x) {
        mask.at(x, 0, 3) = 0;
    }
    saveImage(folder_ / "mask.png", mask, PixelType::uint8);
    EXPECT_EQ(load().maskPixels, size_t{kTestWidth} * (kTestHeight - 1));
    std::filesystem::remove(folder_ / "mask.png");
    saveImage(folder_ / "photo 1.png", mask, PixelType::uint8); // of photographs that are cut out
    CaptureOptions linear;
    linear.transfer = TransferCurve::linear;
    const Capture capture = load(linear);
    EXPECT_EQ(capture.maskPixels, size_t{kTestWidth} * (kTestHeight - 1));
    EXPECT_EQ(capture.maskSource, "photo 1.png, its alpha");
}

TEST_F(CaptureRti, PhotographsBelowTheList)
{
    fs::create_directories(folder_ / "jpeg-exports");
    for (int i = 1; i <= 10; ++i) {
        const std::string name = "photo " + std::to_string(i) + ".png";
        fs::rename(folder_ / name, folder_ / "jpeg-exports" / name);
    }
    EXPECT_EQ(load().photographs[0].exposures[0].file, folder_ / "jpeg-exports" / "photo 1.png");
    // The same from the folder of the photographs, the list lying above.
    const Capture capture = loadCapture(folder_ / "jpeg-exports");
    EXPECT_EQ(capture.layout, CaptureLayout::rti);
    EXPECT_EQ(capture.lightsSource, (fs::canonical(folder_.path()) / "lights.lp").string());
}

// As RTIBuilder leaves it: photographs, the list and what was made of them in folders side by side.
TEST_F(CaptureRti, AProjectOfFoldersSideBySide)
{
    const fs::path project = folder_ / "project", photographs = project / "jpeg-exports";
    fs::create_directories(photographs);
    fs::create_directories(project / "assembly-files");
    std::string list = "10\r\n";
    for (int i = 1; i <= 10; ++i) {
        const std::string name = "photo " + std::to_string(i) + ".png";
        fs::rename(folder_ / name, photographs / name);
        list += "C:\\Users\\anna\\project\\jpeg-exports\\" + name + " 0." + std::to_string(i) + " 0 0.9\r\n";
    }
    fs::remove(folder_ / "lights.lp");
    fs::create_directories(project / "finished-files");
    writeText(project / "assembly-files" / "project.lp", list);
    writeMask(photographs / "mask.png");
    for (const fs::path& given : {project, project / "assembly-files", project / "assembly-files" / "project.lp"}) {
        const Capture capture = loadCapture(given);
        ASSERT_EQ(capture.photographs.size(), 10u) << given;
        EXPECT_TRUE(fs::equivalent(capture.photographs[9].exposures[0].file, photographs / "photo 10.png")) << given;
        EXPECT_EQ(capture.maskPixels, size_t{6} * kTestHeight) << given;
    }
    writeText(project / "finished-files" / "other.lp", list);
    expectError([&] { loadCapture(project); }, {"project", "2 .lp files", "other.lp", "choice of an .lp"});
}

TEST_F(CaptureRti, PhotographsBesideTheListComeBeforeThumbnails)
{
    writePicture(folder_ / "thumbs" / "photo 1.png", testPicture(1, 2, 2));
    EXPECT_EQ(load().photographs[0].exposures[0].file, folder_ / "photo 1.png");
}

TEST_F(CaptureRti, AmbiguousNamesAreRefused)
{
    fs::remove(folder_ / "photo 1.png");
    writePicture(folder_ / "a" / "photo 1.png", 1);
    writePicture(folder_ / "b" / "photo 1.png", 1);
    expectRefused({"lights.lp", "a/photo 1.png", "b/photo 1.png"});
}

TEST_F(CaptureRti, AListAboveOfOtherPhotographsDoesNotCount)
{
    writeUwFolder(folder_ / "cat", "cat", 3);
    EXPECT_EQ(loadCapture(folder_ / "cat").layout, CaptureLayout::uw);
}

TEST(CaptureLights, AllBehindTheObjectAreRefused)
{
    std::vector<Light> lights = {{{0.6f, 0, -0.8f}}, {{0, 0.6f, -0.8f}}, {{-0.6f, 0, -0.8f}}, {{0, 0, -1}}};
    expectError([&] { requireSpanningLights(lights, "x.lp"); }, {"x.lp", "behind"});
    lights[0].direction.z = 0.8f; // one of them may be
    EXPECT_GT(requireSpanningLights(lights, "x.lp"), 0);
}

TEST_F(CaptureRti, AMaskIsFoundByItsName)
{
    writeMask(folder_ / "dome mask.tga");
    EXPECT_EQ(load().maskPixels, size_t{6} * kTestHeight);
    writeMask(folder_ / "mask.png", 4);
    expectRefused({"mask.png", "dome mask.tga", "choice of a mask"});
    CaptureOptions options;
    options.mask = folder_ / "mask.png";
    EXPECT_EQ(load(options).maskPixels, size_t{4} * kTestHeight);
}

TEST_F(CaptureRti, AListedPhotographIsNoMask)
{
    writePicture(folder_ / "death mask.png", 1);
    writeText(folder_ / "lights.lp", "3\ndeath mask.png 1 0 0\nphoto 2.png 0 1 0\nphoto 3.png 0 0 1\n");
    EXPECT_EQ(load().maskPixels, size_t{kTestWidth} * kTestHeight);
}

TEST_F(CaptureRti, MissingPhotographIsNamed)
{
    fs::remove(folder_ / "photo 3.png");
    expectRefused({"lights.lp", "photo 3.png", "is not in"});
}

TEST_F(CaptureRti, APhotographListedTwiceIsRefused)
{
    writeText(folder_ / "lights.lp", "3\nphoto 1.png 1 0 0\nphoto 2.png 0 1 0\nx/photo 1.png 0 0 1\n");
    expectRefused({"lights.lp", "photo 1.png twice"});
}

TEST_F(CaptureRti, CountsHaveToAgree)
{
    writeText(folder_ / "lights.lp", "4\nphoto 1.png 1 0 0\nphoto 2.png 0 1 0\nphoto 3.png 0 0 1\n");
    expectRefused({"lights.lp", "announces 4", "lists 3"});
}

TEST_F(CaptureRti, OfTwoListsTheUserChooses)
{
    writeText(folder_ / "other.lp", "3\nphoto 1.png 1 0 0\nphoto 2.png 0 1 0\nphoto 3.png 0 0 1\n");
    expectRefused({"2 .lp files", "lights.lp", "other.lp", "choice of a rig"});
    CaptureOptions options;
    options.rig = folder_ / "other.lp";
    EXPECT_EQ(load(options).photographs.size(), 3u);
}

} // namespace
} // namespace nacre
