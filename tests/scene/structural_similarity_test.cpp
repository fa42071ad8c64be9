// The structural similarity of pairs whose value is known, and the counting of codes.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/files/hash_random.h"
#include "engine/files/measures.h"

namespace nacre {
namespace {

constexpr double kC1 = 1e-4; // (0.01)^2, of values in [0,1]
// Values are floats; the formula is in doubles.
constexpr double kRounding = 1e-6;

Image constantPicture(float value)
{
    return Image(24, 16, 3, value);
}

Image wavyPicture(int width = 40, int height = 30)
{
    Image picture(width, height, 3);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float wave = std::sin(0.7f * x) * std::cos(0.4f * y);
            picture.setRgb(x, y, {0.5f + 0.3f * wave, 0.4f + 0.2f * wave, 0.6f - 0.3f * wave});
        }
    }
    return picture;
}

Image twoPixels(float left, float right)
{
    Image picture(2, 1, 3);
    picture.setRgb(0, 0, glm::vec3(left));
    picture.setRgb(1, 0, glm::vec3(right));
    return picture;
}

Image noisy(const Image& picture, float amplitude)
{
    Image result = picture;
    for (size_t i = 0; i < result.values.size(); ++i) {
        result.values[i] += amplitude * static_cast<float>(2 * unitFromHash(hashOf(1, i)) - 1);
    }
    return result;
}

TEST(StructuralSimilarity, EqualPicturesHaveOne)
{
    for (const Image& picture : {constantPicture(0), constantPicture(0.7f), wavyPicture(), wavyPicture(3, 2)}) {
        EXPECT_DOUBLE_EQ(structuralSimilarity(picture, picture), 1);
    }
}

// Without contrast only the first factor is left, borders included: (2 a b + C1) / (a^2 + b^2 + C1).
TEST(StructuralSimilarity, ConstantPicturesByTheClosedForm)
{
    for (const auto& [a, b] : {std::pair(0.2, 0.6), std::pair(0.5, 0.51), std::pair(0.0, 1.0)}) {
        const double expected = (2 * a * b + kC1) / (a * a + b * b + kC1);
        EXPECT_NEAR(
            structuralSimilarity(constantPicture(static_cast<float>(a)), constantPicture(static_cast<float>(b))),
            expected, kRounding);
    }
}

// Two pixels: the neighbour weighs e = exp(-1 / (2 1.5^2)) = 0.8007 of the middle, so the weights are p = 1 / (1 + e)
// and q = e / (1 + e), the mean p a0 + q a1, the variance p q (a0 - a1)^2. The figures were computed from these.
TEST(StructuralSimilarity, ScaledShiftedAndInvertedByHand)
{
    const Image a = twoPixels(0.2f, 0.6f);
    EXPECT_NEAR(structuralSimilarity(a, twoPixels(0.1f, 0.3f)), 0.642944578, kRounding) << "half the values";
    EXPECT_NEAR(structuralSimilarity(a, twoPixels(0.3f, 0.7f)), 0.975443201, kRounding) << "0.1 brighter";
    EXPECT_NEAR(structuralSimilarity(a, twoPixels(0.2f, 0.3f)), 0.433106754, kRounding) << "a quarter of the contrast";
    EXPECT_NEAR(structuralSimilarity(a, twoPixels(0.6f, 0.2f)), -0.971513221, kRounding) << "exchanged";
}

// Another implementation's value (ssim.js 3.5.0, "original", no downsampling). It leaves out the windows that reach
// over the border, hence the mask; it rounds its weights otherwise, hence 1e-8.
TEST(StructuralSimilarity, AsAnotherImplementationHasIt)
{
    Image a(70, 50, 3), b = a;
    std::vector<uint8_t> inside(a.pixelCount(), 0);
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const int p = 3 * std::abs((4 * x + 3 * y) % 128 - 64) + 20;
            const int q = std::clamp(p * 4 / 5 + (x * 7919 + y * 104729) % 61 - 20, 0, 255);
            a.setRgb(x, y, glm::vec3(p / 255.0f));
            b.setRgb(x, y, glm::vec3(q / 255.0f));
            inside[y * a.width + x] = x >= 5 && x < a.width - 5 && y >= 5 && y < a.height - 5;
        }
    }
    EXPECT_NEAR(structuralSimilarity(a, b, inside), 0.660001342, 1e-8);
}

TEST(StructuralSimilarity, IsSymmetric)
{
    const Image a = wavyPicture(), b = noisy(a, 0.1f);
    EXPECT_DOUBLE_EQ(structuralSimilarity(a, b), structuralSimilarity(b, a));
}

TEST(StructuralSimilarity, FallsAsNoiseGrows)
{
    const Image picture = wavyPicture();
    double before = 1;
    for (const float codes : {1, 2, 4, 8, 16, 32, 64}) {
        const double found = structuralSimilarity(picture, noisy(picture, codes / 255));
        EXPECT_LT(found, before) << codes;
        EXPECT_GT(found, 0) << codes;
        before = found;
    }
    EXPECT_LT(before, 0.6);
}

// Luma would not see it.
TEST(StructuralSimilarity, SeesExchangedColours)
{
    const Image picture = wavyPicture();
    Image exchanged = picture;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const glm::vec3 v = picture.rgb(x, y);
            exchanged.setRgb(x, y, {v.z, v.y, v.x});
        }
    }
    EXPECT_LT(structuralSimilarity(picture, exchanged), 0.5);
}

TEST(StructuralSimilarity, MaskChoosesWindowsByTheirMiddle)
{
    const Image a = wavyPicture();
    Image b = a;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 20; x < a.width; ++x) {
            b.setRgb(x, y, glm::vec3(0.5f));
        }
    }
    std::vector<uint8_t> farFromIt(a.pixelCount(), 0), besideIt = farFromIt, none = farFromIt;
    for (int y = 0; y < a.height; ++y) {
        std::fill_n(&farFromIt[y * a.width], 15, uint8_t{1});
        besideIt[y * a.width + 15] = 1;
    }
    EXPECT_DOUBLE_EQ(structuralSimilarity(a, b, farFromIt), 1);
    EXPECT_LT(structuralSimilarity(a, b, besideIt), 0.9999) << "its windows reach into the other half";
    EXPECT_LT(structuralSimilarity(a, b), structuralSimilarity(a, b, besideIt));
    EXPECT_TRUE(std::isnan(structuralSimilarity(a, b, none)));
}

TEST(CodeDifference, CountsPixelsByTheirWorstChannel)
{
    Image a(4, 1, 3, 100 / 255.0f), b = a;
    b.setRgb(1, 0, glm::vec3(102, 97, 100) / 255.0f);
    b.setRgb(2, 0, glm::vec3(100, 100, 104) / 255.0f);
    b.setRgb(3, 0, glm::vec3(150) / 255.0f);
    const std::vector<uint8_t> mask = {1, 1, 1, 0};
    const CodeDifference found = codeDifference(a, b, mask, 3);
    EXPECT_EQ(found.largest, 4);
    EXPECT_EQ(found.beyond, 1u);
    EXPECT_EQ(found.pixels, 3u);
    EXPECT_DOUBLE_EQ(found.share(), 1.0 / 3);
    EXPECT_EQ(codeDifference(a, b, 2).beyond, 3u);
    EXPECT_EQ(codeDifference(a, b, 2).largest, 50);
    EXPECT_EQ(codeDifference(a, a, 0).largest, 0);
}

} // namespace
} // namespace nacre
