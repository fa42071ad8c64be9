#include "acquisition/capture/photograph_files.h"

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"
#include "tests/support/write_capture.h"

namespace nacre {
namespace {

using std::string_literals::operator""s;

class ProgressivePictures : public testing::Test {
protected:
    bool isProgressiveText(const std::string& bytes)
    {
        writeText(folder_ / "picture", bytes);
        return isProgressive(folder_ / "picture");
    }
    TempFolder folder_;
};

TEST_F(ProgressivePictures, OurOwnPicturesAreNot)
{
    for (const char* name : {"a.png", "a.jpg", "a.tif", "a.exr", "a.tga"}) {
        writePicture(folder_ / name, 1);
        EXPECT_FALSE(isProgressive(folder_ / name)) << name;
    }
}

TEST_F(ProgressivePictures, PngByItsInterlaceMethod)
{
    const std::string header = "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x01\0\0\0\x01\x08\x02\0\0"s;
    EXPECT_TRUE(isProgressiveText(header + "\1"));
    EXPECT_FALSE(isProgressiveText(header + "\0"s));
}

TEST_F(ProgressivePictures, JpegByItsFrame)
{
    // Start, an APP0 of 4 bytes, a table of 5 with a fill byte in front, then the frame.
    const std::string start = "\xff\xd8\xff\xe0\0\x04\xff\xc2\xff\xff\xc4\0\x05\xff\xc2\0"s;
    EXPECT_TRUE(isProgressiveText(start + "\xff\xc2\0\x0b"s));
    EXPECT_TRUE(isProgressiveText(start + "\xff\xca\0\x0b"s));
    EXPECT_FALSE(isProgressiveText(start + "\xff\xc0\0\x0b"s));
    EXPECT_FALSE(isProgressiveText(start + "\xff\xc1\0\x0b\xff\xc2\0\x0b"s));
    EXPECT_FALSE(isProgressiveText(start));
}

TEST_F(ProgressivePictures, AnythingElseIsNot)
{
    EXPECT_FALSE(isProgressiveText(""));
    EXPECT_FALSE(isProgressiveText("\xff"));
    EXPECT_FALSE(isProgressive(folder_ / "missing.png"));
}

} // namespace
} // namespace nacre
