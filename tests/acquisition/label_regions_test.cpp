// Labels as pictures: regions, borders, files.
#include <gtest/gtest.h>

#include "acquisition/capture/capture_maps.h"
#include "acquisition/segmentation/label_regions.h"
#include "acquisition/segmentation/material_tree.h"
#include "acquisition/segmentation/segmentation.h"
#include "engine/files/hash_random.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

constexpr int kSide = 32;

Capture emptyCapture()
{
    Capture capture;
    capture.name = "thing";
    capture.width = capture.height = kSide;
    capture.window = {0, 0, kSide, kSide, 1, kSide, kSide};
    capture.mask.assign(kSide * kSide, 1);
    capture.maskPixels = capture.mask.size();
    return capture;
}

// The value of a pixel, of 255, at its place.
template <class Value> std::filesystem::path writeLabels(const TempFolder& folder, int channels, Value&& value)
{
    Image picture(kSide, kSide, channels);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            for (int c = 0; c < channels; ++c) {
                picture.at(x, y, c) = static_cast<float>(value(x, y, c)) / 255;
            }
        }
    }
    saveImage(folder / "labels.png", picture, PixelType::uint8);
    return folder / "labels.png";
}

TEST(LabelPicture, ValuesBecomeMaterialsAndBlackTakesTheNearest)
{
    const TempFolder folder;
    const Capture capture = emptyCapture();
    const auto file = writeLabels(folder, 1, [](int x, int, int) { return x < 10 ? 40 : x < 12 || x > 29 ? 0 : 200; });
    const Segmentation labels = segmentationOf(loadLabelPicture(file, capture), capture);
    ASSERT_EQ(labels.regions.size(), 2u);
    EXPECT_EQ(labels.regions[0].name, "thing-40");
    EXPECT_EQ(labels.regions[1].name, "thing-200");
    for (int x = 0; x < kSide; ++x) {
        EXPECT_EQ(labels.labels[5 * kSide + x], x < 11 ? 0 : 1) << x; // column 10 is nearer to 9, 11 to 12
        EXPECT_EQ(labels.inner[5 * kSide + x], x < 9 || x > 12) << x; // two pixels on either side of the border
    }
    EXPECT_EQ(labels.regions[0].pixels, 11u * kSide);
    EXPECT_EQ(labels.regions[0].inner, 9u * kSide);
}

TEST(LabelPicture, ColoursCountAndWhatStandsBesideTheObjectDoesNot)
{
    const TempFolder folder;
    Capture capture = emptyCapture();
    std::fill_n(capture.mask.begin(), kSide * 8, uint8_t{0}); // the top
    const auto file = writeLabels(folder, 3, [](int x, int y, int c) {
        return y < 4 ? 77 : x < 16 ? 255 * (c == 0) : 255 * (c == 1); // red and green of equal brightness in no grey
    });
    const LabelPicture picture = loadLabelPicture(file, capture);
    EXPECT_EQ(picture.names, (std::vector<std::string>{"00ff00", "ff0000"}));
    EXPECT_EQ(picture.labels[20 * kSide + 2], 1);
    EXPECT_EQ(picture.labels[20 * kSide + 30], 0);
}

TEST(LabelPicture, WhatCannotBeLabelsIsRefusedByName)
{
    const TempFolder folder;
    Capture capture = emptyCapture();
    const auto load = [&](const std::filesystem::path& file) { return [&, file] { loadLabelPicture(file, capture); }; };
    expectError(load(writeLabels(folder, 1, [](int x, int y, int) { return (y * kSide + x) % 256; })),
                {"labels.png", "different values"});
    expectError(load(writeLabels(folder, 1, [](int, int, int) { return 0; })), {"labels.png", "black"});
    capture.window.fileWidth = kSide + 1;
    expectError(load(writeLabels(folder, 1, [](int, int, int) { return 9; })), {"labels.png", "32 x 32", "33 x 32"});
}

TEST(LabelPicture, ABoxHasTheLabelOfMostOfItsPixels)
{
    Capture capture = emptyCapture();
    capture.window.box = 2;
    capture.width = capture.height = kSide / 2;
    std::vector<uint8_t> labels(kSide * kSide, 3);
    labels[0] = labels[1] = labels[kSide] = 1; // three of four
    labels[2] = 5;                             // one of four
    labels[4] = labels[5] = 7;                 // two and two
    const std::vector<uint8_t> windowed = windowedLabels(labels, capture);
    ASSERT_EQ(windowed.size(), size_t{kSide / 2 * kSide / 2});
    EXPECT_EQ(windowed[0], 1);
    EXPECT_EQ(windowed[1], 3);
    EXPECT_EQ(windowed[2], 3);
}

TEST(LabelRegions, SmallPartsGoToTheirNeighboursAndLonelyOnesStay)
{
    std::vector<uint8_t> mask(kSide * kSide, 1), labels(kSide * kSide, 0);
    for (int y = 0; y < kSide; ++y) {
        mask[y * kSide + 28] = 0; // parts columns 29 to 31 from the rest
        for (int x = 29; x < kSide; ++x) {
            labels[y * kSide + x] = 2;
        }
    }
    labels[5 * kSide + 5] = labels[5 * kSide + 6] = 1;
    for (int i = 0; i < 25; ++i) {
        labels[(15 + i / 5) * kSide + 15 + i % 5] = 1;
    }
    dissolveSmallParts({kSide, kSide, mask}, 20, labels);
    EXPECT_EQ(labels[5 * kSide + 5], 0);
    EXPECT_EQ(labels[16 * kSide + 16], 1); // 25 pixels
    dissolveSmallParts({kSide, kSide, mask}, 200, labels);
    EXPECT_EQ(labels[16 * kSide + 16], 0);
    EXPECT_EQ(labels[3 * kSide + 30], 2); // 96 pixels, but nothing beside them
}

TEST(LabelRegions, AMaterialThinnerThanTheBorderKeepsItsPixels)
{
    const TempFolder folder;
    const Capture capture = emptyCapture();
    const auto file = writeLabels(folder, 1, [](int x, int, int) { return x == 16 ? 90 : 30; });
    const Segmentation labels = segmentationOf(loadLabelPicture(file, capture), capture);
    ASSERT_EQ(labels.regions.size(), 2u);
    EXPECT_EQ(labels.regions[1].inner, size_t{kSide});
    EXPECT_EQ(labels.inner[7 * kSide + 16], 1);
    EXPECT_EQ(labels.inner[7 * kSide + 15], 0);
}

std::vector<float> twoGroups(size_t first, size_t second, float gap)
{
    std::vector<float> values;
    for (size_t i = 0; i < first + second; ++i) {
        values.push_back(static_cast<float>(0.1 * gaussianFromHash(hashOf(3, i))) + (i < first ? 0 : gap));
    }
    return values;
}

TEST(DensityValley, IsFoundBetweenGroupsAndNotWithinOneNorByChance)
{
    const ValleyOptions options{0.05f, 0.1f, 0.5, 20};
    const auto valley = deepestValley(twoGroups(900, 100, 1), options);
    ASSERT_TRUE(valley.has_value());
    EXPECT_NEAR(valley->threshold, 0.5, 0.2); // anywhere in the empty middle
    EXPECT_NEAR(valley->gap, 1, 0.1);         // a bandwidth or two
    EXPECT_FALSE(deepestValley(twoGroups(1000, 0, 0), options).has_value());
    EXPECT_FALSE(deepestValley(twoGroups(500, 500, 0.15f), options).has_value()); // 1.5 deviations: one hump
    EXPECT_FALSE(deepestValley(twoGroups(990, 10, 1), options).has_value());      // fewer than 20
    // Sixty values with a kernel of a tenth of their scatter: ragged, but no more than Poisson's law allows.
    EXPECT_FALSE(deepestValley(twoGroups(60, 0, 0), {0.01f, 0.01f, 0.5, 5}).has_value());
    EXPECT_FALSE(deepestValley({}, options).has_value());
    EXPECT_FALSE(deepestValley(std::vector<float>(100, 2.0f), options).has_value());
}

} // namespace
} // namespace nacre
