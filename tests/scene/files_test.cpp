#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "engine/files/whole_file.h"
#include "engine/surface/surface.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

Image gradient(int width, int height, int channels)
{
    Image image(width, height, channels);
    for (size_t i = 0; i < image.values.size(); ++i) {
        image.values[i] = static_cast<float>(i % 251) / 250.0f;
    }
    return image;
}

BrdfTable smallTable()
{
    BrdfTable table({5, 4, 3}, {kHalfDifference, 0.4f});
    for (size_t i = 0; i < table.values.size(); ++i) {
        table.values[i] = {0.1f * i, 1.0f / (1 + i), 100.0f * i};
        table.confidence[i] = static_cast<float>(i) / table.values.size();
    }
    return table;
}

TEST(ImageFiles, RoundTripOfEveryPixelType)
{
    const TempFolder folder;
    const Image image = gradient(13, 7, 3);
    const struct {
        const char* name;
        PixelType type;
        float tolerance; // half a code value; half floats keep 11 bits
    } cases[] = {{"a.png", PixelType::uint8, 0.5f / 255}, {"b.png", PixelType::uint16, 0.5f / 65535},
                 {"c.exr", PixelType::half, 1.0f / 2048}, {"d.exr", PixelType::float32, 0},
                 {"e.tif", PixelType::float32, 0},        {"f.tif", PixelType::uint8, 0.5f / 255}};
    for (const auto& c : cases) {
        saveImage(folder / c.name, image, c.type);
        const Image back = loadImage(folder / c.name);
        ASSERT_EQ(back.values.size(), image.values.size()) << c.name;
        for (size_t i = 0; i < image.values.size(); ++i) {
            EXPECT_NEAR(back.values[i], image.values[i], c.tolerance * 1.001f) << c.name;
        }
    }
}

TEST(ImageFiles, LinearIsSaidAndTheReadersGuessDoesNotCount)
{
    const TempFolder folder;
    saveImage(folder / "linear.png", gradient(4, 4, 3), PixelType::uint16);
    saveImage(folder / "display.png", gradient(4, 4, 3), PixelType::uint8);
    EXPECT_TRUE(readImageHeader(folder / "linear.png").curveIsDeclared);
    EXPECT_EQ(readImageHeader(folder / "linear.png").curve, TransferCurve::linear);
    EXPECT_EQ(readImageHeader(folder / "display.png").curve, TransferCurve::srgb);
}

TEST(ImageFiles, RowsAreThePictureAndSrgbIsDecodedWhereAsked)
{
    const TempFolder folder;
    const Image image = gradient(9, 11, 3);
    saveImage(folder / "p.png", image, PixelType::uint16);
    ImageRows rows(folder / "p.png", TransferCurve::linear);
    EXPECT_TRUE(rows.streams());
    std::vector<float> band(9 * 3 * 4);
    rows.read(0, 4, band);
    rows.read(6, 10, band);
    EXPECT_NEAR(band[0], image.at(0, 6, 0), 1e-5f);
    const Image decoded = loadPhotograph(folder / "p.png", TransferCurve::srgb);
    EXPECT_NEAR(decoded.at(4, 4, 1), std::pow((image.at(4, 4, 1) + 0.055f) / 1.055f, 2.4f), 1e-4f);
}

TEST(ImageFiles, ExrChannelsAreFoundByName)
{
    const TempFolder folder;
    Image image(2, 1, 4);
    image.values = {1, 2, 3, 4, 5, 6, 7, 8};
    saveImage(folder / "rgba.exr", image, PixelType::float32);
    EXPECT_EQ(loadImage(folder / "rgba.exr").values, image.values);
}

TEST(ImageFiles, BadFilesAreNamed)
{
    const TempFolder folder;
    expectError([&] { loadImage(folder / "none.png"); }, {"none.png: does not exist"});
    writeText(folder / "text.png", "not a picture");
    expectError([&] { loadImage(folder / "text.png"); }, {"text.png: cannot be read"});
    saveImage(folder / "whole.png", gradient(64, 64, 3), PixelType::uint16);
    std::filesystem::resize_file(folder / "whole.png", std::filesystem::file_size(folder / "whole.png") / 2);
    expectError([&] { loadPhotograph(folder / "whole.png", TransferCurve::linear); },
                {"whole.png: cannot be read to its end"});
    Image bad = gradient(3, 3, 3);
    bad.at(2, 1, 0) = std::numeric_limits<float>::quiet_NaN();
    saveImage(folder / "nan.exr", bad, PixelType::float32);
    expectError([&] { loadPhotograph(folder / "nan.exr", TransferCurve::linear); }, {"nan.exr", "pixel 2, 1"});
    expectError([&] { saveImage(folder / "x.doc", bad, PixelType::uint8); }, {"x.doc", "picture format"});
}

// A file-size limit stands for a full disk: writes fail part of the way.
class SmallDisk {
public:
    explicit SmallDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN))
    {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~SmallDisk()
    {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

private:
    rlimit before_{};
    void (*handler_)(int);
};

// A pixel of 8 bits a channel (TIFF 6.0, 1992): photometric interpretation 5 is CMYK, 8 CIE Lab.
std::string onePixelTiff(int photometric, int channels)
{
    std::string bytes = "II*";
    const auto number = [&](uint32_t value, int count) {
        for (int i = 0; i < count; ++i) {
            bytes += static_cast<char>(value >> 8 * i & 0xff);
        }
    };
    number(0, 1), number(8, 4), number(9, 2);
    const auto entry = [&](uint32_t tag, uint32_t value) {
        number(tag, 2), number(4, 2), number(1, 4), number(value, 4);
    };
    entry(256, 1), entry(257, 1), entry(258, 8), entry(259, 1), entry(262, static_cast<uint32_t>(photometric));
    entry(273, 8 + 2 + 9 * 12 + 4), entry(277, static_cast<uint32_t>(channels)), entry(278, 1);
    entry(279, static_cast<uint32_t>(channels));
    number(0, 4);
    return bytes + std::string(static_cast<size_t>(channels), 'a');
}

TEST(ImageFiles, InksAreRefused)
{
    const TempFolder folder;
    writeText(folder / "a.tif", onePixelTiff(2, 3));
    EXPECT_EQ(readImageHeader(folder / "a.tif").channels, 3);
    writeText(folder / "a.tif", onePixelTiff(5, 4));
    expectError([&] { readImageHeader(folder / "a.tif"); }, {"a.tif", "CMYK", "RGB"});
    writeText(folder / "a.tif", onePixelTiff(8, 3));
    expectError([&] { readImageHeader(folder / "a.tif"); }, {"a.tif", "LAB", "RGB"});
}

TEST(ImageFiles, AFullDiskLeavesNothingBehind)
{
    const TempFolder folder;
    Image image(200, 200, 3);
    std::mt19937 noise; // does not compress
    for (float& value : image.values) {
        value = static_cast<float>(noise() % 65536) / 65535;
    }
    Surface surface = transferredSurface(sphereNormalMap(128), {"m", smallTable(), {}});
    for (const char* name : {"big.png", "big.exr"}) {
        const SmallDisk disk(20000);
        expectError([&] { saveImage(folder / name, image, PixelType::uint16); }, {name, "cannot be written"});
    }
    {
        const SmallDisk disk(20000);
        expectError([&] { saveSurface(folder / "s.nacre", surface, false); }, {"cannot be written"});
        expectError([&] { writeTextFile(folder / "t.json", std::string(50000, 'x')); },
                    {"t.json", "cannot be written"});
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "something half-written stayed";
}

TEST(WholeOutput, RefusesWhatExistsAndReplacesOnRequest)
{
    const TempFolder folder;
    writeTextFile(folder / "a.txt", "old");
    expectError([&] { WholeOutput(folder / "a.txt", false); }, {"a.txt: exists already", "a new name"});
    expectError([&] { WholeOutput(folder / "no" / "a.txt", false); }, {"its folder does not exist"});
    {
        WholeOutput abandoned(folder / "a.txt", true);
        std::ofstream(abandoned.temporary()) << "half";
    }
    EXPECT_EQ(readTextFile(folder / "a.txt"), "old");
}

TEST(TableFiles, RoundTripIsExact)
{
    const TempFolder folder;
    for (const int coordinates : {kHalfDifference, kNatural, kOneWay}) {
        BrdfTable table = smallTable();
        table.domain.coordinates = coordinates;
        saveBrdfTable(folder / "t.exr", table);
        const BrdfTable back = loadBrdfTable(folder / "t.exr");
        EXPECT_EQ(back.size, table.size);
        EXPECT_EQ(back.domain.coordinates, coordinates);
        EXPECT_EQ(back.domain.thetaDMax, table.domain.thetaDMax);
        EXPECT_EQ(back.values, table.values);
        EXPECT_EQ(back.confidence, table.confidence);
    }
    saveImage(folder / "plain.exr", gradient(4, 4, 4), PixelType::float32);
    expectError([&] { loadBrdfTable(folder / "plain.exr"); }, {"plain.exr: holds no BRDF table"});
}

TEST(TableFiles, SamplingIsTrilinearAndExactAtTexels)
{
    const BrdfTable table = smallTable();
    const BrdfValue texel = sampleTable(table, {2.0f / 4, 1.0f / 3, 1.0f});
    EXPECT_NEAR(texel.value.x, table.values[table.index(2, 1, 2)].x, 1e-4f);
    const BrdfValue middle = sampleTable(table, {2.5f / 4, 0, 0});
    EXPECT_NEAR(middle.value.x, 0.25f, 1e-5f);
}

TEST(SurfaceFiles, RoundTripAndReplacement)
{
    const TempFolder folder;
    Surface surface = transferredSurface(sphereNormalMap(16), {"plastic", smallTable(), {}});
    surface.materials[0].coverage = {std::vector<float>(60, 0.25f), std::vector<float>(60, 3)};
    surface.materials[0].table.error.assign(60, 0.25f);
    surface.lights = {{"a.png", {{0, 0.6f, 0.8f}, {1, 2, 3}}}};
    surface.albedo = Image(16, 16, 3, 1.5f);
    surface.scale = RadianceScale::absolute;
    saveSurface(folder / "s.nacre", surface, false);
    expectError([&] { saveSurface(folder / "s.nacre", surface, false); }, {"exists already"});
    saveSurface(folder / "s.nacre/", surface, true);
    const Surface back = loadSurface(folder / "s.nacre");
    EXPECT_EQ(back.labels, surface.labels);
    EXPECT_EQ(back.normals.confidence, surface.normals.confidence);
    EXPECT_EQ(back.materials[0].name, "plastic");
    EXPECT_EQ(back.materials[0].table.values, surface.materials[0].table.values);
    EXPECT_EQ(back.materials[0].table.error, surface.materials[0].table.error);
    EXPECT_EQ(back.materials[0].coverage.count, surface.materials[0].coverage.count);
    EXPECT_EQ(back.albedo.values, surface.albedo.values);
    EXPECT_EQ(back.lights[0].photograph, "a.png");
    EXPECT_EQ(back.lights[0].light.direction, surface.lights[0].light.direction);
    EXPECT_EQ(back.scale, RadianceScale::absolute);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "a temporary stayed";
}

TEST(SurfaceFiles, ShadowsAreCastByHeightsAlone)
{
    const TempFolder folder;
    Surface surface = transferredSurface(sphereNormalMap(16), {"m", smallTable(), {}});
    surface.height = Image(16, 16, 1, 2.0f);
    surface.castsShadows = true;
    saveSurface(folder / "s.nacre", surface, false);
    const Surface back = loadSurface(folder / "s.nacre");
    EXPECT_TRUE(back.castsShadows);
    EXPECT_EQ(back.height.values, surface.height.values);
    surface.height = {};
    saveSurface(folder / "s.nacre", surface, true);
    expectError([&] { loadSurface(folder / "s.nacre"); }, {"surface.json", "shadows", "no heights"});
}

TEST(SurfaceFiles, DamageIsNamed)
{
    const TempFolder folder;
    expectError([&] { loadSurface(folder / "none.nacre"); }, {"none.nacre: is not a surface"});
    saveSurface(folder / "s.nacre", transferredSurface(sphereNormalMap(16), {"m", smallTable(), {}}), false);
    writeText(folder / "s.nacre" / "surface.json", "{\"format\": \"nacre surface\", \"version\": 99}");
    expectError([&] { loadSurface(folder / "s.nacre"); }, {"surface.json: version is 99", "at most 1"});
    writeText(folder / "s.nacre" / "surface.json", "{");
    expectError([&] { loadSurface(folder / "s.nacre"); }, {"surface.json: is not JSON"});
}

TEST(NormalMaps, OfTwoChannelsAreCompletedAndThoseThatFaceAwayRefused)
{
    const TempFolder folder;
    Image codes(4, 4, 3, 0.0f);
    for (size_t i = 0; i < codes.pixelCount(); ++i) {
        codes.values[3 * i] = 0.8f; // x = 0.6
        codes.values[3 * i + 1] = 0.5f;
    }
    saveImage(folder / "two.png", codes, PixelType::uint16);
    const NormalMap map = loadNormalMap(folder / "two.png", NormalY::gl);
    EXPECT_NEAR(map.normals[5].x, 0.6f, 1e-3f);
    EXPECT_NEAR(map.normals[5].z, 0.8f, 1e-3f);
    for (size_t i = 0; i < codes.pixelCount(); ++i) {
        codes.values[3 * i + 2] = 0.1f; // z = -0.8
    }
    saveImage(folder / "away.png", codes, PixelType::uint16);
    expectError([&] { loadNormalMap(folder / "away.png", NormalY::gl); }, {"away.png", "faces away in 100 %"});
}

TEST(NormalMaps, CodedAndFloatFilesRoundTripAndGreenFlips)
{
    const TempFolder folder;
    const NormalMap sphere = sphereNormalMap(32);
    saveNormalMap(folder / "n.exr", sphere);
    const NormalMap exact = loadNormalMap(folder / "n.exr");
    EXPECT_EQ(exact.normals, sphere.normals);
    saveNormalMap(folder / "n.png", sphere);
    const NormalMap coded = loadNormalMap(folder / "n.png"), flipped = loadNormalMap(folder / "n.png", NormalY::dx);
    EXPECT_EQ(coded.confidence, sphere.confidence) << "black is no data";
    const size_t i = sphere.index(16, 5);
    EXPECT_NEAR(coded.normals[i].y, sphere.normals[i].y, 1e-4f);
    EXPECT_NEAR(flipped.normals[i].y, -sphere.normals[i].y, 1e-4f);
    saveImage(folder / "black.png", Image(8, 8, 3), PixelType::uint16);
    expectError([&] { loadNormalMap(folder / "black.png"); }, {"black.png: holds no normal"});
}

TEST(Display, AutomaticExposurePutsThe99thPercentileAt0Point9)
{
    Image radiance(100, 10, 3);
    for (size_t i = 0; i < 3000; ++i) {
        const size_t pixel = i / 3;
        radiance.values[i] = 0.02f * static_cast<float>(pixel + 1);
    }
    const float gain = std::exp2(automaticExposure(radiance));
    EXPECT_NEAR(gain * 0.02f * 990, 0.9, 0.002);
    EXPECT_EQ(automaticExposure(Image(4, 4, 3)), 0) << "black stays black";
}

} // namespace
} // namespace nacre
