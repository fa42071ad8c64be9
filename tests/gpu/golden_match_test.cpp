// What keeps goldens honest: refusals, evidence, and that nothing is blessed in silence.
#include "engine/files/whole_file.h"
#include "tests/gpu/golden_match.h"
#include "tests/support/temp_folder.h"

namespace nacre::test {
namespace {
namespace fs = std::filesystem;

// Smooth in every channel, with contrast in every window.
Image waves(int width = 64, int height = 64)
{
    Image picture(width, height, 3);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::vec3 code(40 + 4 * (x % 32), 30 + 5 * (y % 32), 60 + 3 * ((x + y) % 40));
            picture.setRgb(x, y, code / 255.0f);
        }
    }
    return picture;
}

class GoldenMatch : public testing::Test {
protected:
    testing::AssertionResult match(const Image& picture) const
    {
        saveImage(files_.evidence / "actual.png", picture, PixelType::uint8);
        return matchesGolden(files_.evidence / "actual.png", files_);
    }
    testing::AssertionResult bless(const Image& picture) const
    {
        saveImage(files_.evidence / "actual.png", picture, PixelType::uint8);
        return blessGolden(files_.evidence / "actual.png", files_);
    }
    void keep(const Image& picture) const { saveImage(files_.golden, picture, PixelType::uint8); }

    void expectRefused(const testing::AssertionResult& result, const std::string& fragment) const
    {
        EXPECT_FALSE(result);
        EXPECT_NE(std::string(result.message()).find(fragment), std::string::npos) << result.message();
    }

    TempFolder folder_;
    GoldenFiles files_{folder_ / "golden.kept.png", folder_.path()};
};

TEST_F(GoldenMatch, TakesTheSameAndWhatRoundingMoves)
{
    keep(waves());
    EXPECT_TRUE(match(waves()));
    Image near = waves();
    for (size_t i = 0; i < near.values.size(); i += 20) {
        near.values[i] += 1 / 255.0f;
    }
    EXPECT_TRUE(match(near));
    EXPECT_FALSE(fs::exists(folder_ / "difference.png"));
}

TEST_F(GoldenMatch, LeavesEvidence)
{
    keep(waves());
    Image other = waves();
    for (int x = 0; x < 8; ++x) {
        other.setRgb(x, 0, glm::vec3(0));
    }
    const testing::AssertionResult result = match(other);
    expectRefused(result, "8 of 4096 pixels (0.195 %)");
    expectRefused(result, folder_.path().string());
    EXPECT_EQ(codeDifference(loadImage(folder_ / "golden.png"), waves(), 0).largest, 0);
    EXPECT_GT(loadImage(folder_ / "difference.png").at(0, 0), 0.9f);
    EXPECT_EQ(loadImage(folder_ / "difference.png").at(0, 1), 0);
    EXPECT_NE(readTextFile(folder_ / "figures.txt").find("SSIM"), std::string::npos);
}

// One code is rounding, two are not.
TEST_F(GoldenMatch, RefusesFaintNoise)
{
    keep(waves());
    Image noise = waves();
    for (size_t i = 0; i < noise.values.size(); i += 5) {
        noise.values[i] += (i % 2 == 0 ? 2 : -2) / 255.0f;
    }
    EXPECT_FALSE(match(noise));
}

TEST_F(GoldenMatch, RefusesGoldensThatGuardNothing)
{
    expectRefused(match(waves()), "is missing");
    keep(Image(64, 64, 3, 0.5f));
    expectRefused(match(Image(64, 64, 3, 0.5f)), "is of one colour");
    keep(waves(32, 64));
    expectRefused(match(waves()), "is 32x64x3; the picture is 64x64x3");
    Image black = waves();
    std::fill_n(black.values.begin(), black.values.size() * 3 / 4, 0.0f);
    keep(black);
    expectRefused(match(black), "is black in 75 %");
    Image clipped = waves();
    std::fill_n(clipped.values.begin(), clipped.values.size() / 8, 1.0f);
    keep(clipped);
    expectRefused(match(clipped), "is clipped in 12 %");
    Image flat(64, 64, 3, 0.5f);
    flat.setRgb(0, 0, glm::vec3(0.25f));
    keep(flat);
    expectRefused(match(flat), "has 2 colours only");
}

TEST_F(GoldenMatch, BlessingIsNeverSilentAndNeverGreen)
{
    expectRefused(bless(waves()), "before: nothing");
    EXPECT_EQ(codeDifference(loadImage(files_.golden), waves(), 0).largest, 0);
    Image other = waves();
    for (int x = 0; x < 64; ++x) {
        other.setRgb(x, 3, glm::vec3(0.1f));
    }
    expectRefused(bless(other), "before: 64 of 4096 pixels");
    expectRefused(bless(other), "before: 0 of 4096 pixels");
    expectRefused(bless(Image(64, 64, 3)), "not blessed");
    EXPECT_TRUE(match(other));
}

} // namespace
} // namespace nacre::test
