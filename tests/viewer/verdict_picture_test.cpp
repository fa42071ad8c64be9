#include "engine/view_state/verdict_picture.h"

#include <gtest/gtest.h>

namespace nacre {
namespace {

TEST(VerdictPicture, ColoursEveryPixelByItsVerdict)
{
    const std::vector<uint8_t> verdicts = {0, 1, 2, 3, kNotJudged, 0};
    const Image picture = verdictPicture(verdicts, {3, 2}, 3, 2);
    for (size_t i = 0; i < verdicts.size(); ++i) {
        const glm::vec3 wanted = verdicts[i] == kNotJudged ? glm::vec3(0) : kVerdictKinds[verdicts[i]].colour;
        const glm::vec3 found = picture.rgb(static_cast<int>(i % 3), static_cast<int>(i / 3));
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(found[c], wanted[c], 0.5 / 255 + 1e-6) << i; // rounded to a code
        }
    }
}

TEST(VerdictPicture, IsFittedAsSurfacesAre)
{
    const std::vector<uint8_t> verdicts = {1, 2};
    const Image picture = verdictPicture(verdicts, {2, 1}, 4, 6); // two rows in the middle
    EXPECT_EQ(picture.rgb(0, 0), glm::vec3(0));
    EXPECT_EQ(picture.rgb(0, 2), picture.rgb(1, 3));
    EXPECT_NE(picture.rgb(1, 2), picture.rgb(2, 2));
    EXPECT_EQ(picture.rgb(2, 5), glm::vec3(0));
}

TEST(VerdictPicture, SharesAreOfWhatWasJudged)
{
    const std::vector<uint8_t> verdicts = {0, 0, 1, kNotJudged, 3, kNotJudged};
    const auto shares = verdictShares(verdicts);
    EXPECT_DOUBLE_EQ(shares[0], 0.5);
    EXPECT_DOUBLE_EQ(shares[1], 0.25);
    EXPECT_DOUBLE_EQ(shares[2], 0);
    EXPECT_DOUBLE_EQ(shares[3], 0.25);
    EXPECT_DOUBLE_EQ(verdictShares({})[0], 0) << "nothing is no division by nothing";
    const std::string text = describeVerdicts(verdicts);
    for (const VerdictKind& kind : kVerdictKinds) {
        EXPECT_NE(text.find(kind.name), std::string::npos) << text;
    }
}

} // namespace
} // namespace nacre
