#include "acquisition/capture/picture_files.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

TEST(PictureFiles, NumbersCompareAsNumbers)
{
    EXPECT_TRUE(naturalLess("horse.9.tga", "horse.10.tga"));
    EXPECT_FALSE(naturalLess("horse.10.tga", "horse.9.tga"));
    EXPECT_TRUE(naturalLess("IMG_099.png", "IMG_100.png"));
    EXPECT_TRUE(naturalLess("a2b10", "a2b11"));
    EXPECT_TRUE(naturalLess("a", "a1"));
    EXPECT_TRUE(naturalLess("b1", "C1")); // letters without case
    EXPECT_FALSE(naturalLess("a1", "a1"));
    // Too long for any integer type.
    EXPECT_TRUE(naturalLess("x99999999999999999999999998", "x99999999999999999999999999"));
}

TEST(PictureFiles, OrderIsStrictWhereNumbersAreEqual)
{
    EXPECT_NE(naturalLess("a01", "a1"), naturalLess("a1", "a01"));
    EXPECT_NE(naturalLess("A1", "a1"), naturalLess("a1", "A1"));
}

TEST(PictureFiles, KnowsPicturesByExtensionInAnyCase)
{
    for (const char* name : {"a.tga", "a.PNG", "a.Jpg", "a.tif", "a.EXR", "a.CR2", "a.nef", "a.dng", "a.0.hdr"}) {
        EXPECT_TRUE(hasPictureExtension(name)) << name;
    }
    for (const char* name : {"a.txt", "a", "a.xmp", "a.lp", "png", "a.png.txt"}) {
        EXPECT_FALSE(hasPictureExtension(name)) << name;
    }
}

TEST(PictureFiles, ListsPicturesInNaturalOrderWithoutHiddenOnes)
{
    const TempFolder folder;
    for (const char* name : {"p10.png", "p9.png", "._p9.png", "p1.JPG", "notes.txt", "sub/p2.png"}) {
        writeText(folder / name, "");
    }
    const std::vector<std::filesystem::path> expected{folder / "p1.JPG", folder / "p9.png", folder / "p10.png"};
    EXPECT_EQ(picturesIn(folder.path()), expected);
}

TEST(PictureFiles, NumberedPicturesWithAMaskComeBeforeOthers)
{
    const TempFolder folder;
    for (const char* name : {"cat.0.png", "cat.1.png", "cat.mask.tif", "thumb.0.png", "cat.0.xmp"}) {
        writeText(folder / name, "");
    }
    const auto found = findNumberedPictures(folder.path());
    ASSERT_TRUE(found);
    EXPECT_EQ(found->name, "cat");
    EXPECT_EQ(found->photographs.size(), 2u);
    EXPECT_EQ(found->masks, std::vector<std::filesystem::path>{folder / "cat.mask.tif"});
}

TEST(PictureFiles, NoNumbersNoNumberedPictures)
{
    const TempFolder folder;
    writeText(folder / "photo1.png", "");
    writeText(folder / "a.mask.png", "");
    EXPECT_FALSE(findNumberedPictures(folder.path()));
}

TEST(PictureFiles, RefusesANumberTwiceAndTwoNames)
{
    const TempFolder folder;
    writeText(folder / "cat.1.png", "");
    writeText(folder / "cat.01.tga", "");
    expectError([&] { findNumberedPictures(folder.path()); }, {"same number", "cat.1.png", "cat.01.tga"});
    std::filesystem::remove(folder / "cat.01.tga");
    writeText(folder / "dog.1.png", "");
    EXPECT_FALSE(findNumberedPictures(folder.path())); // the numbers may be anything's
    writeText(folder / "cat.mask.png", "");
    writeText(folder / "dog.mask.png", "");
    expectError([&] { findNumberedPictures(folder.path()); }, {"2 names", "cat", "dog"});
}

} // namespace
} // namespace nacre
