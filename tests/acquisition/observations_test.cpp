#include "acquisition/capture/observations.h"

#include <algorithm>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/support/write_capture.h"

namespace nacre {
namespace {

constexpr float kHalfCode16 = 0.5f / 65535 * 1.01f; // rounding to a code, and of the floats themselves

class ObservationsTest : public testing::Test {
protected:
    // One photograph of one file.
    void add(const std::string& name, const Image& picture, double seconds = 1)
    {
        writePicture(folder_ / name, picture);
        capture_.photographs.push_back({name, {{folder_ / name, seconds}}});
    }
    Observations readAll()
    {
        ObservationReader reader(capture_, 1);
        Observations block;
        EXPECT_TRUE(reader.next(block));
        Observations end;
        EXPECT_FALSE(reader.next(end));
        return block;
    }
    void useMask(const std::vector<uint8_t>& mask, int width, int height)
    {
        capture_.width = width;
        capture_.height = height;
        capture_.mask = mask;
        capture_.maskPixels = static_cast<size_t>(std::count(mask.begin(), mask.end(), uint8_t{1}));
    }
    void SetUp() override
    {
        useMask(std::vector<uint8_t>(size_t{kTestWidth} * kTestHeight, 1), kTestWidth, kTestHeight);
    }

    TempFolder folder_;
    Capture capture_;
};

TEST_F(ObservationsTest, ShowWhatThePhotographsHoldInsideTheMask)
{
    for (int i = 0; i < 3; ++i) {
        add(std::to_string(i) + ".png", testPicture(i));
    }
    std::fill_n(capture_.mask.begin(), 10, uint8_t{0});
    capture_.mask[20] = 0;
    const Observations all = readAll();
    EXPECT_EQ(all.lightCount, 3u);
    ASSERT_EQ(all.pixels.size(), size_t{kTestWidth} * kTestHeight - 11);
    EXPECT_EQ(all.pixels[0], 10u);
    EXPECT_EQ(all.pixels[9], 19u);
    EXPECT_EQ(all.pixels[10], 21u);
    for (size_t i = 0; i < all.pixels.size(); ++i) {
        for (int light = 0; light < 3; ++light) {
            const auto x = static_cast<int>(all.pixels[i] % kTestWidth);
            const auto y = static_cast<int>(all.pixels[i] / kTestWidth);
            const glm::vec3 expected = testPicture(light).rgb(x, y);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(all.radianceOf(i)[light][c], expected[c], kHalfCode16);
            }
            EXPECT_EQ(all.saturatedOf(i)[light], 0);
        }
    }
}

TEST_F(ObservationsTest, GreyPhotographsHaveThreeEqualChannels)
{
    const Image grey = testPicture(1, kTestWidth, kTestHeight, 1);
    add("grey.exr", grey);
    const Observations all = readAll();
    for (size_t i = 0; i < all.pixels.size(); ++i) {
        EXPECT_EQ(all.radiance[i], glm::vec3(grey.values[i]));
    }
}

TEST_F(ObservationsTest, ExposureTimeIsDividedOutOfIntegersAndFloats)
{
    add("a.png", testPicture(1), 0.25);
    add("b.exr", testPicture(1), 0.25);
    const Observations all = readAll();
    const float expected = testPicture(1).rgb(0, 0).x * 4;
    EXPECT_NEAR(all.radianceOf(0)[0].x, expected, 4 * kHalfCode16);
    EXPECT_EQ(all.radianceOf(0)[1].x, expected);
}

TEST_F(ObservationsTest, FloatsBeyondOneAreKeptAndNotSaturated)
{
    add("a.exr", Image(kTestWidth, kTestHeight, 3, 12.5f));
    add("b.png", Image(kTestWidth, kTestHeight, 3, 1.0f));
    const Observations all = readAll();
    EXPECT_EQ(all.radianceOf(0)[0], glm::vec3(12.5f));
    EXPECT_EQ(all.saturatedOf(0)[0], 0);
    EXPECT_EQ(all.saturatedOf(0)[1], 1);
}

TEST_F(ObservationsTest, SrgbIsDecodedWhereTheCaptureSaysSo)
{
    add("a.png", Image(kTestWidth, kTestHeight, 3, 0.5f));
    capture_.curve = TransferCurve::srgb;
    EXPECT_NEAR(readAll().radiance[0].x, 0.21404f, 1e-4f); // IEC 61966-2-1 of 0.5
}

TEST_F(ObservationsTest, BracketsReachBeyondFullScale)
{
    Image radiance(kTestWidth, kTestHeight, 3);
    for (size_t i = 0; i < radiance.values.size(); ++i) {
        radiance.values[i] = 0.05f * static_cast<float>(i + 1); // to 7.2, full scale of the short exposure is 8
    }
    Photograph bracket{"b", {}};
    for (const float seconds : {1.0f, 0.125f}) {
        Image exposed = radiance;
        for (float& value : exposed.values) {
            value *= seconds; // saveImage clips
        }
        const std::string name = std::to_string(seconds) + ".png";
        writePicture(folder_ / name, exposed);
        bracket.exposures.push_back({folder_ / name, seconds});
    }
    capture_.photographs.push_back(bracket);
    const Observations all = readAll();
    for (size_t i = 0; i < all.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) { // eight times the rounding of the short exposure
            EXPECT_NEAR(all.radiance[i][c], radiance.values[3 * i + c], 8 * kHalfCode16);
        }
        EXPECT_EQ(all.saturated[i], 0);
    }
}

TEST_F(ObservationsTest, ValuesThatAreNotFiniteAreNamed)
{
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Image picture = testPicture(1);
        picture.at(3, 2, 1) = bad;
        capture_.photographs.clear();
        add("good.exr", testPicture(0));
        add("bad.exr", picture);
        expectError([&] { readAll(); }, {"bad.exr", "pixel (3, 2)", "not finite"});
    }
}

TEST_F(ObservationsTest, ValuesOutsideTheMaskMayBeAnything)
{
    Image picture = testPicture(1);
    picture.at(3, 2, 1) = std::numeric_limits<float>::quiet_NaN();
    add("bad.exr", picture);
    capture_.mask[2 * kTestWidth + 3] = 0;
    EXPECT_EQ(readAll().pixels.size(), size_t{kTestWidth} * kTestHeight - 1);
}

TEST_F(ObservationsTest, OfSeveralErrorsTheFirstPhotographsIsThrown)
{
    Image picture = testPicture(1);
    picture.values[0] = std::numeric_limits<float>::quiet_NaN();
    add("good.exr", testPicture(0));
    for (int i = 0; i < 8; ++i) {
        add("bad" + std::to_string(i) + ".exr", picture);
    }
    expectError(
        [&] {
            Observations block;
            ObservationReader(capture_, 4).next(block);
        },
        {"bad0.exr"});
}

TEST_F(ObservationsTest, APhotographThatEndsEarlyIsNamed)
{
    add("whole.tif", testPicture(0, 300, 300));
    add("cut.tif", testPicture(1, 300, 300));
    useMask(std::vector<uint8_t>(size_t{300} * 300, 1), 300, 300);
    std::filesystem::resize_file(folder_ / "cut.tif", std::filesystem::file_size(folder_ / "cut.tif") / 2);
    expectError([&] { readAll(); }, {"cut.tif"});
}

TEST_F(ObservationsTest, APhotographThatChangedItsSizeIsNamed)
{
    add("a.png", testPicture(0, 9, 6));
    expectError([&] { readAll(); }, {"a.png", "9 x 6", "8 x 6"});
}

TEST_F(ObservationsTest, ReaderMayBeMovedAndOutlivesTheCapture)
{
    add("a.png", testPicture(0));
    auto capture = std::make_unique<Capture>(capture_);
    ObservationReader first(*capture, 1);
    capture.reset();
    ObservationReader second = std::move(first);
    Observations block;
    EXPECT_TRUE(second.next(block));
    EXPECT_EQ(block.pixels.size(), size_t{kTestWidth} * kTestHeight);
}

} // namespace
} // namespace nacre

namespace nacre {
namespace {

TEST(PixelSample, HasOnePixelOfEverySquareThatHoldsOne)
{
    // A disc and a line one pixel wide, which a plain grid of every n-th pixel could miss.
    constexpr int kWidth = 300;
    std::vector<uint32_t> pixels;
    for (int y = 0; y < kWidth; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const int dx = x - 100, dy = y - 100;
            if (dx * dx + dy * dy < 90 * 90 || x == 251) {
                pixels.push_back(static_cast<uint32_t>(y * kWidth + x));
            }
        }
    }
    const PixelSample sample = samplePixels(pixels, kWidth);
    ASSERT_GT(sample.spacing, 1);
    const auto squareOf = [&](uint32_t pixel) {
        return std::pair(pixel / kWidth / static_cast<uint32_t>(sample.spacing),
                         pixel % kWidth / static_cast<uint32_t>(sample.spacing));
    };
    std::set<std::pair<uint32_t, uint32_t>> of, all;
    for (const uint32_t pixel : sample.pixels) {
        EXPECT_TRUE(of.insert(squareOf(pixel)).second) << pixel;
        EXPECT_TRUE(std::binary_search(pixels.begin(), pixels.end(), pixel));
    }
    for (const uint32_t pixel : pixels) {
        all.insert(squareOf(pixel));
    }
    EXPECT_EQ(of, all);
    EXPECT_TRUE(std::is_sorted(sample.pixels.begin(), sample.pixels.end()));
    EXPECT_EQ(samplePixels({5, 9}, kWidth).pixels, (std::vector<uint32_t>{5, 9}));
}

} // namespace
} // namespace nacre
