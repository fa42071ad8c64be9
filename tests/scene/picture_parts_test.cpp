// Files that hold several pictures, or one that does not fill its frame.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include "engine/files/image.h"
#include "engine/files/picture_parts.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

constexpr int kPartSide = 8;

OIIO::ImageSpec partSpec(const std::string& name, const std::vector<std::string>& channels, int side = kPartSide)
{
    OIIO::ImageSpec spec(side, side, static_cast<int>(channels.size()), OIIO::TypeDesc::FLOAT);
    spec.channelnames = channels;
    spec.attribute("oiio:subimagename", name);
    return spec;
}

// Every part holds its number in all channels, plus a tenth for each channel.
void writeParts(const std::filesystem::path& file, const std::vector<OIIO::ImageSpec>& specs)
{
    const auto output = OIIO::ImageOutput::create(file.string());
    ASSERT_TRUE(output->open(file.string(), static_cast<int>(specs.size()), specs.data()));
    for (size_t i = 0; i < specs.size(); ++i) {
        std::vector<float> values(specs[i].image_pixels() * specs[i].nchannels);
        for (size_t k = 0; k < values.size(); ++k) {
            values[k] = static_cast<float>(i) + 0.1f * static_cast<float>(k % specs[i].nchannels);
        }
        ASSERT_TRUE(i == 0 || output->open(file.string(), specs[i], OIIO::ImageOutput::AppendSubimage));
        ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, values.data()));
    }
    ASSERT_TRUE(output->close());
}

TEST(PictureParts, TheOneInColourAndFullSizeIsTaken)
{
    const TempFolder folder;
    const struct {
        const char* name;
        std::vector<OIIO::ImageSpec> specs;
        std::vector<float> pixel;
    } cases[] = {
        {"depth_first.exr", {partSpec("depth", {"Z"}), partSpec("beauty", {"R", "G", "B"})}, {1, 1.1f, 1.2f}},
        {"thumbnail.tif", {partSpec("", {"R", "G", "B"}, 3), partSpec("", {"R", "G", "B"})}, {1, 1.1f, 1.2f}},
        {"grey.tif", {partSpec("", {"R", "G", "B"}, 3), partSpec("", {"Y"})}, {1}},
        {"layer.exr", {partSpec("", {"V.Depth.Z", "V.Combined.B", "V.Combined.G", "V.Combined.R"})}, {.3f, .2f, .1f}},
        {"with_depth.exr", {partSpec("", {"R", "G", "B", "Z"})}, {0, 0.1f, 0.2f}},
        {"normals.exr", {partSpec("", {"X", "Y", "Z"})}, {0, 0.1f, 0.2f}},
    };
    for (const auto& c : cases) {
        writeParts(folder / c.name, c.specs);
        const Image image = loadPhotograph(folder / c.name, TransferCurve::linear);
        ASSERT_EQ(image.width, kPartSide) << c.name;
        ASSERT_EQ(image.channels, static_cast<int>(c.pixel.size())) << c.name;
        std::vector<float> expected = c.pixel, first(image.values.begin(), image.values.begin() + image.channels);
        EXPECT_NEAR(first[0], expected[0], 1e-6f) << c.name;
        EXPECT_NEAR(first.back(), expected.back(), 1e-6f) << c.name;
        EXPECT_EQ(loadImage(folder / c.name).values, image.values) << c.name;
    }
}

TEST(PictureParts, WhatLeavesAChoiceIsRefusedAndListed)
{
    const TempFolder folder;
    writeParts(folder / "views.exr", {partSpec("left", {"R", "G", "B"}), partSpec("right", {"R", "G", "B"})});
    expectError([&] { readImageHeader(folder / "views.exr"); },
                {"views.exr: holds several pictures: left of 8 x 8 (R,G,B), right of 8 x 8 (R,G,B)", "full size"});
    writeParts(folder / "layers.exr", {partSpec("", {"a.R", "a.G", "a.B", "b.R", "b.G", "b.B"})});
    expectError([&] { readImageHeader(folder / "layers.exr"); }, {"layers.exr", "a.R,a.G,a.B,b.R"});
    const std::vector<PicturePart> pages(9, {"", 4, 4, {"Y"}});
    EXPECT_FALSE(choosePicture(pages));
    EXPECT_NE(describe(pages).find("picture 1 of 4 x 4 (Y)"), std::string::npos);
    EXPECT_NE(describe(pages).find("and 3 more"), std::string::npos);
}

// Croppings of one picture, wherever they lie, are that picture where they have pixels, in bands as in whole.
TEST(PictureParts, ADataWindowStandsWhereTheDisplayWindowHasIt)
{
    const TempFolder folder;
    for (const OIIO::ROI& data : {OIIO::ROI(2, 7, 1, 5), OIIO::ROI(-3, 4, -2, 3), OIIO::ROI(5, 12, 6, 11),
                                  OIIO::ROI(-2, 11, -1, 10), OIIO::ROI(20, 24, 20, 24)}) {
        OIIO::ImageSpec spec(data, OIIO::TypeDesc::FLOAT);
        spec.full_x = spec.full_y = 0;
        spec.full_width = spec.full_height = kPartSide;
        spec.nchannels = 1;
        spec.channelnames = {"Y"};
        const auto valueAt = [](int x, int y) { return static_cast<float>(100 + 10 * y + x); };
        std::vector<float> values;
        for (int y = data.ybegin; y < data.yend; ++y) {
            for (int x = data.xbegin; x < data.xend; ++x) {
                values.push_back(valueAt(x, y));
            }
        }
        const auto file = folder / "cropped.exr";
        const auto output = OIIO::ImageOutput::create(file.string());
        ASSERT_TRUE(output->open(file.string(), spec) && output->write_image(OIIO::TypeDesc::FLOAT, values.data()) &&
                    output->close());
        Image expected(kPartSide, kPartSide, 1);
        for (int y = std::max(0, data.ybegin); y < std::min(kPartSide, data.yend); ++y) {
            for (int x = std::max(0, data.xbegin); x < std::min(kPartSide, data.xend); ++x) {
                expected.at(x, y) = valueAt(x, y);
            }
        }
        EXPECT_EQ(loadImage(file).values, expected.values);
        ImageRows rows(file, TransferCurve::linear);
        Image banded(kPartSide, kPartSide, 1);
        for (int y = 0; y < kPartSide; y += 3) {
            const int last = std::min(y + 3, kPartSide);
            rows.read(y, last, std::span(banded.values).subspan(y * kPartSide, (last - y) * kPartSide));
        }
        EXPECT_EQ(banded.values, expected.values);
    }
}

} // namespace
} // namespace nacre
