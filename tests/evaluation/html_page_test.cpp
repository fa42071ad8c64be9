#include "evaluation/charts/html_page.h"

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

TEST(HtmlPage, PicturesAreBase64OfRfc4648)
{
    const TempFolder folder;
    const auto encoded = [&](const std::string& bytes) {
        writeText(folder / "f", bytes);
        return dataUri(folder / "f", "png");
    };
    // The vectors of RFC 4648, section 10.
    EXPECT_EQ(encoded("f"), "data:image/png;base64,Zg==");
    EXPECT_EQ(encoded("fo"), "data:image/png;base64,Zm8=");
    EXPECT_EQ(encoded("foobar"), "data:image/png;base64,Zm9vYmFy");
}

} // namespace
} // namespace nacre
