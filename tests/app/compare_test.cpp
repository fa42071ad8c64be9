// nacre compare as its users start it.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/files/image.h"
#include "tests/support/run_nacre.h"

namespace nacre {
namespace {

Image ramp()
{
    Image picture(40, 20, 3);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            picture.setRgb(x, y, glm::vec3(20 + 5 * x, 200 - 4 * y, 60 + 2 * x) / 255.0f);
        }
    }
    return picture;
}

class Compare : public testing::Test {
protected:
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    ProgramRun compare(const std::string& a, const std::string& b, std::vector<std::string> more = {})
    {
        std::vector<std::string> all = {"compare", path(a), path(b)};
        all.insert(all.end(), more.begin(), more.end());
        return runNacre(all);
    }
    nlohmann::json figures(const std::string& a, const std::string& b, std::vector<std::string> more = {})
    {
        more.insert(more.end(), {"--json", path("figures.json")});
        std::filesystem::remove(path("figures.json"));
        const ProgramRun run = compare(a, b, more);
        EXPECT_EQ(run.exitCode, 0) << run.err;
        return nlohmann::json::parse(std::ifstream(path("figures.json")));
    }

    TempFolder folder_;
};

TEST_F(Compare, CountsStoredCodes)
{
    Image other = ramp();
    for (int x = 0; x < 8; ++x) {
        other.at(x, 3, 1) += (x < 4 ? 3 : 9) / 255.0f;
    }
    saveImage(path("a.png"), ramp(), PixelType::uint8);
    saveImage(path("b.png"), other, PixelType::uint8);
    const nlohmann::json found = figures("b.png", "a.png");
    EXPECT_EQ(found["largestCodeDifference"], 9);
    EXPECT_EQ(found["codeTolerance"], 4);
    EXPECT_DOUBLE_EQ(found["shareBeyondTolerance"], 4.0 / 800);
    EXPECT_LT(found["structuralSimilarity"], 1);
    EXPECT_GT(found["structuralSimilarity"], 0.9);
    EXPECT_DOUBLE_EQ(figures("b.png", "a.png", {"--code-tolerance", "2"})["shareBeyondTolerance"], 8.0 / 800);
    EXPECT_EQ(figures("a.png", "a.png")["structuralSimilarity"], 1);
    const std::string out = compare("b.png", "a.png").out;
    EXPECT_NE(out.find("codes differ by 9 of 255 at most, 0.500 % of the pixels by more than 4"), std::string::npos)
        << out;
}

// Radiance and twice as much of it, each shown with the reference's peak as white: 0.5 is sRGB's code 188, 0.25 is 137.
TEST_F(Compare, RadianceIsShownBeforeItsCodesAreCompared)
{
    saveImage(path("a.exr"), Image(16, 16, 3, 1.0f), PixelType::float32);
    saveImage(path("b.exr"), Image(16, 16, 3, 0.5f), PixelType::float32);
    EXPECT_EQ(figures("b.exr", "a.exr", {"--peak", "2"})["largestCodeDifference"], 188 - 137);
}

TEST_F(Compare, BoundsDecideTheExitCode)
{
    saveImage(path("a.png"), ramp(), PixelType::uint8);
    saveImage(path("b.png"), Image(40, 20, 3, 0.4f), PixelType::uint8);
    EXPECT_EQ(compare("a.png", "a.png", {"--ssim-at-least", "1"}).exitCode, 0);
    const ProgramRun far = compare("b.png", "a.png", {"--ssim-at-least", "0.9"});
    EXPECT_EQ(far.exitCode, 1);
    EXPECT_NE(far.err.find("at least 0.90000"), std::string::npos) << far.err;
    EXPECT_EQ(compare("b.png", "a.png", {"--code-tolerance", "-1"}).exitCode, 2);
}

} // namespace
} // namespace nacre
