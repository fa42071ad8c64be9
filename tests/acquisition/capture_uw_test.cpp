#include <algorithm>

#include <gtest/gtest.h>

#include "acquisition/capture/capture.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/support/write_capture.h"

namespace nacre {
namespace {

TEST(CaptureUw, IsFoundWithItsMaskAndInNaturalOrder)
{
    const TempFolder folder;
    writeUwFolder(folder / "set", "cat", 12);
    const Capture capture = loadCapture(folder / "set");
    EXPECT_EQ(capture.layout, CaptureLayout::uw);
    EXPECT_EQ(capture.name, "cat");
    EXPECT_EQ(capture.folder, folder / "set");
    ASSERT_EQ(capture.photographs.size(), 12u);
    for (size_t i = 0; i < 12; ++i) { // 9 before 10
        EXPECT_EQ(capture.photographs[i].name, "cat." + std::to_string(i) + ".tga");
        EXPECT_EQ(capture.photographs[i].exposures.size(), 1u);
        EXPECT_EQ(capture.photographs[i].exposures[0].seconds, 1.0);
    }
    EXPECT_EQ(capture.width, kTestWidth);
    EXPECT_EQ(capture.height, kTestHeight);
    EXPECT_EQ(capture.maskPixels, size_t{6} * kTestHeight); // the mask leaves two columns out
    EXPECT_EQ(capture.mask[1], 0);
    EXPECT_EQ(capture.mask[2], 1);
    EXPECT_TRUE(capture.lights.empty());
    EXPECT_TRUE(capture.truthNormals.empty());
    EXPECT_EQ(capture.curve, TransferCurve::linear);
    EXPECT_EQ(capture.curveSource, "assumed: the files declare none");
}

TEST(CaptureUw, TakesPicturesOfAnyKindAndMixedExtensions)
{
    for (const char* extension : {".png", ".exr", ".tif", ".TGA"}) {
        const TempFolder folder;
        writeUwFolder(folder.path(), "cat", 3, extension);
        EXPECT_EQ(loadCapture(folder.path()).photographs.size(), 3u) << extension;
    }
}

TEST(CaptureUw, WithoutMaskEveryPixelCounts)
{
    const TempFolder folder;
    writeUwFolder(folder.path(), "cat", 3);
    std::filesystem::remove(folder / "cat.mask.tga");
    EXPECT_EQ(loadCapture(folder.path()).maskPixels, size_t{kTestWidth} * kTestHeight);
}

TEST(CaptureUw, SpheresComeFromFoldersOfTheirOwn)
{
    const TempFolder folder;
    writeUwFolder(folder / "cat", "cat", 11);
    writeUwFolder(folder / "chrome", "chrome", 11);
    for (int i = 1; i <= 11; ++i) { // any names, another size
        writePicture(folder / "gray" / ("IMG_" + std::to_string(i) + ".png"), testPicture(i, 5, 4));
    }
    writeMask(folder / "gray" / "sphere_Mask.tif", 2, 5, 4);
    CaptureOptions options;
    options.mirrorSphere = folder / "chrome";
    options.diffuseSphere = folder / "gray";
    const Capture capture = loadCapture(folder / "cat", options);
    ASSERT_TRUE(capture.mirrorSphere && capture.diffuseSphere);
    EXPECT_EQ(capture.mirrorSphere->photographs[10].name, "chrome.10.tga");
    EXPECT_EQ(capture.mirrorSphere->maskFile, folder / "chrome" / "chrome.mask.tga");
    EXPECT_EQ(capture.mirrorSphere->source, folder / "chrome");
    EXPECT_EQ(capture.diffuseSphere->photographs[9].name, "IMG_10.png");
    EXPECT_EQ(capture.diffuseSphere->maskFile, folder / "gray" / "sphere_Mask.tif");
    EXPECT_FALSE(capture.diffuseSphere->circle);
}

class CaptureUwSpheres : public testing::Test {
protected:
    CaptureUwSpheres()
    {
        writeUwFolder(folder_ / "cat", "cat", 4);
        writeUwFolder(folder_ / "chrome", "chrome", 4);
        options_.mirrorSphere = folder_ / "chrome";
    }
    void expectRefused(const std::vector<std::string>& fragments)
    {
        expectError([&] { loadCapture(folder_ / "cat", options_); }, fragments);
    }
    TempFolder folder_;
    CaptureOptions options_;
};

TEST_F(CaptureUwSpheres, NeedAPhotographForEachOfTheObject)
{
    std::filesystem::remove(folder_ / "chrome" / "chrome.2.tga");
    expectRefused({"chrome", "3 photographs of a sphere", "4 of the object"});
}

TEST_F(CaptureUwSpheres, NeedAMask)
{
    std::filesystem::remove(folder_ / "chrome" / "chrome.mask.tga");
    expectRefused({"chrome", "4 photographs and 0 masks"});
}

TEST_F(CaptureUwSpheres, NeedOneMask)
{
    writeMask(folder_ / "chrome" / "chrome.mask.png");
    expectRefused({"chrome", "4 photographs and 2 masks"});
}

TEST_F(CaptureUwSpheres, NeedAMaskOfTheirSize)
{
    writeMask(folder_ / "chrome" / "chrome.mask.tga", 1, 5, 5);
    expectRefused({"chrome.mask.tga", "5 x 5", "8 x 6"});
}

TEST_F(CaptureUwSpheres, NeedOneSize)
{
    writePicture(folder_ / "chrome" / "chrome.3.tga", testPicture(1, 9, 6));
    expectRefused({"chrome.3.tga", "9 x 6", "8 x 6"});
}

TEST_F(CaptureUwSpheres, NeedAMaskThatIsNotEmpty)
{
    writeMask(folder_ / "chrome" / "chrome.mask.tga", kTestWidth);
    expectRefused({"chrome.mask.tga", "empty mask"});
}

TEST_F(CaptureUwSpheres, NeedTheirFolder)
{
    options_.mirrorSphere = folder_ / "silver";
    expectRefused({"silver", "does not exist"});
}

} // namespace
} // namespace nacre
