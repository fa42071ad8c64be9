// What the picture around an object says of its mask, and of a camera that moved.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include "acquisition/chain/capture_preparation.h"
#include "acquisition/checks/camera_shake.h"
#include "assets/synth/synth_capture.h"
#include "engine/files/image.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

// A bumpy solid on ground that the lights reach as well.
class PictureChecks : public testing::Test {
protected:
    PictureChecks()
    {
        SynthOptions options;
        options.width = options.height = 160;
        options.lights = 12;
        options.giveLights = true;
        options.format = SynthFormat::exr;
        options.sphereSize = 48; // not looked at
        writeSynthCapture(folder_ / "c", makeSynthScene(options), false);
        capture_ = loadCapture(folder_ / "c");
        change([&](const Image& image, size_t i, int x, int y) {
            const Light& light = capture_.lights[i];
            const bool isGround = capture_.mask[static_cast<size_t>(y) * image.width + x] == 0;
            return isGround ? 0.3f * light.irradiance * light.direction.z : image.rgb(x, y);
        });
    }
    // Each photograph's file gets what `make` says: (before, index, x, y).
    template <class Make> void change(Make&& make)
    {
        for (size_t i = 0; i < capture_.photographs.size(); ++i) {
            const std::filesystem::path file = capture_.photographs[i].exposures[0].file;
            const Image before = loadImage(file);
            Image after = before;
            for (int y = 0; y < after.height; ++y) {
                for (int x = 0; x < after.width; ++x) {
                    after.setRgb(x, y, make(before, i, x, y));
                }
            }
            saveImage(file, after, PixelType::float32);
        }
    }
    SelfChecks checks() const
    {
        AcquireOptions options;
        StageClock clock;
        const PreparedCapture prepared =
            reconcileCapture(capture_, options, clock, [](const std::string&, double) {}).first;
        return {prepared.reconciled.findings, prepared.reconciled.figures};
    }
    static double figureOf(const SelfChecks& checks, FindingCode code)
    {
        for (const CheckFigure& figure : checks.figures) {
            if (figure.code == code) {
                return figure.value;
            }
        }
        return std::numeric_limits<double>::quiet_NaN();
    }

    TempFolder folder_;
    Capture capture_;
};

TEST_F(PictureChecks, AGoodCaptureHearsOfNothing)
{
    const SelfChecks found = checks();
    EXPECT_FALSE(contains(found.findings, FindingCode::maskElsewhere));
    EXPECT_FALSE(contains(found.findings, FindingCode::cameraShake));
    EXPECT_LT(figureOf(found, FindingCode::maskElsewhere), 0.2);
    EXPECT_LT(figureOf(found, FindingCode::cameraShake), 0.3); // pixels; noise and gloss
}

TEST_F(PictureChecks, AnotherObjectsMaskOnLitGroundIsTold)
{
    capture_.maskPixels = 0;
    for (int y = 0; y < capture_.height; ++y) { // a slanted bar, half of it on the ground
        for (int x = 0; x < capture_.width; ++x) {
            const bool isInside = x > 8 && x < 150 && std::abs(y - 20 - x / 2) < 30 && y > 4 && y < 154;
            capture_.mask[static_cast<size_t>(y) * capture_.width + x] = isInside ? 1 : 0;
            capture_.maskPixels += isInside;
        }
    }
    const SelfChecks found = checks();
    EXPECT_TRUE(contains(found.findings, FindingCode::maskElsewhere)) << figureOf(found, FindingCode::maskElsewhere);
    EXPECT_FALSE(contains(found.findings, FindingCode::maskDark)) << "the ground is lit";
}

TEST_F(PictureChecks, ShakeIsToldByItsSize)
{
    std::mt19937 random(3);
    std::uniform_int_distribution<int> shift(-3, 3);
    std::vector<glm::ivec2> shifts;
    double squares = 0;
    glm::dvec2 mean(0);
    for (size_t i = 0; i < capture_.photographs.size(); ++i) {
        shifts.emplace_back(shift(random), shift(random));
        mean += glm::dvec2(shifts.back()) / 12.0;
    }
    for (const glm::ivec2& s : shifts) {
        squares += glm::dot(glm::dvec2(s) - mean, glm::dvec2(s) - mean) / 11;
    }
    change([&](const Image& image, size_t i, int x, int y) {
        return image.rgb(std::clamp(x + shifts[i].x, 0, image.width - 1),
                         std::clamp(y + shifts[i].y, 0, image.height - 1));
    });
    const SelfChecks found = checks();
    ASSERT_TRUE(contains(found.findings, FindingCode::cameraShake));
    // What goes with the lights is set aside, of so few photographs by chance up to a third.
    EXPECT_NEAR(figureOf(found, FindingCode::cameraShake), std::sqrt(squares), 0.35 * std::sqrt(squares));
}

TEST_F(PictureChecks, WhatIsNotFiniteAroundTheObjectTellsNothing)
{
    change([&](const Image& image, size_t, int x, int y) {
        return x == 0 ? glm::vec3(std::numeric_limits<float>::quiet_NaN()) : image.rgb(x, y);
    });
    const SelfChecks found = checks();
    EXPECT_TRUE(std::isnan(figureOf(found, FindingCode::maskElsewhere)));
}

TEST(ShakeTiles, CoverTheObjectOrAreNone)
{
    constexpr int kWidth = 200, kHeight = 130;
    std::vector<uint8_t> mask(kWidth * kHeight, 1);
    const ShakeTiles all = shakeTiles(mask, kWidth, kHeight);
    EXPECT_EQ(all.corners.size(), 15u);
    const std::vector<uint8_t> tiled = all.mask(kWidth, kHeight);
    EXPECT_EQ(std::count(tiled.begin(), tiled.end(), 1), 15 * ShakeTiles::kSide * ShakeTiles::kSide);
    std::fill(mask.begin() + 60 * kWidth, mask.end(), uint8_t{0});
    for (int y = 0; y < 60; ++y) {
        std::fill_n(mask.begin() + y * kWidth + 45, kWidth - 45, uint8_t{0});
    }
    EXPECT_TRUE(shakeTiles(mask, kWidth, kHeight).corners.empty()) << "an object of little more than a tile";
}

} // namespace
} // namespace nacre
