// Height maps to normals, and the surface file that holds heights.
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/files/measures.h"
#include "engine/target/height_map.h"
#include "engine/target/normal_map_source.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

namespace nacre::test {
namespace {

constexpr int kSize = 65;

// Up to the right and up, 0 to 1.
Image ramp()
{
    Image image(kSize, kSize, 1);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            image.at(x, y) = 0.5f * (x + (kSize - 1 - y)) / (kSize - 1.0f);
        }
    }
    return image;
}

TEST(HeightMap, ARampLeansAgainstItsRise)
{
    const TempFolder folder;
    saveImage(folder / "ramp.png", ramp(), PixelType::uint16);
    const HeightMap map = loadHeightMap(folder / "ramp.png", heightScaleFromArgument("64px"));
    EXPECT_FALSE(map.eightBit);
    const Surface surface = surfaceOfHeight(map.height);
    const glm::vec3 expected = glm::normalize(glm::vec3(-0.5f, -0.5f, 1));
    for (const glm::vec3& n : surface.normals.normals) {
        ASSERT_LT(degreesBetween(n, expected), 0.1); // 16 bits: 0.001 pixels a code
    }
    EXPECT_NEAR(surface.height.at(kSize - 1, 0) - surface.height.at(0, kSize - 1), 64, 0.01);
}

TEST(HeightMap, ScalesArePixelsOrSharesOfTheWidth)
{
    EXPECT_EQ(heightScaleFromArgument("12").pixels(100), 12);
    EXPECT_EQ(heightScaleFromArgument("-12px").pixels(100), -12);
    EXPECT_FLOAT_EQ(heightScaleFromArgument("5%").pixels(200), 10);
    for (const char* text : {"", "px", "0", "nan", "5 %", "5m", "5%%"}) {
        expectError([&] { heightScaleFromArgument(text); }, {"height scale", "not understood"}, Error::kUsage);
    }
    const TempFolder folder;
    saveImage(folder / "f.exr", ramp(), PixelType::float32);
    EXPECT_EQ(loadHeightMap(folder / "f.exr", {}).scale, 1) << "floats are pixels";
    saveImage(folder / "i.png", ramp(), PixelType::uint8);
    EXPECT_FLOAT_EQ(loadHeightMap(folder / "i.png", {}).scale, 0.05f * kSize);
    EXPECT_TRUE(loadHeightMap(folder / "i.png", {}).eightBit);
    saveImage(folder / "c.png", Image(4, 4, 3, 0.5f), PixelType::uint8);
    EXPECT_EQ(loadHeightMap(folder / "c.png", {}).height.channels, 1);
    Image colour(4, 4, 3, 0.5f);
    colour.at(1, 1, 2) = 0;
    saveImage(folder / "d.png", colour, PixelType::uint8);
    expectError([&] { loadHeightMap(folder / "d.png", {}); }, {"d.png", "in colour", "height map"});
}

TEST(HeightMap, HolesHaveNoNormalAndDoNotBendTheirNeighbours)
{
    Image image = ramp();
    image.at(20, 20) = std::numeric_limits<float>::quiet_NaN();
    const Surface surface = surfaceOfHeight(image);
    const size_t hole = surface.normals.index(20, 20);
    EXPECT_EQ(surface.normals.confidence[hole], 0);
    EXPECT_EQ(surface.height.values[hole], 0);
    EXPECT_EQ(surface.labels[hole], Surface::kNoMaterial);
    EXPECT_LT(degreesBetween(surface.normals.normals[hole + 1], surface.normals.normals[0]), 0.01);
}

// Heights to normals and back: central differences and the trapezoidal rule agree but for the curvature.
TEST(HeightMap, IntegratingItsNormalsGivesItBack)
{
    Image image(120, 100, 1);
    double mean = 0;
    for (int y = 0; y < 100; ++y) {
        for (int x = 0; x < 120; ++x) {
            image.at(x, y) = 6 * std::sin(x / 13.0f) * std::sin(y / 15.0f);
            mean += image.at(x, y) / 12000;
        }
    }
    const IntegratedSurface back = surfaceOfNormals(surfaceOfHeight(image).normals);
    for (size_t i = 0; i < image.values.size(); ++i) {
        ASSERT_NEAR(back.surface.height.values[i], image.values[i] - mean, 0.15);
    }
}

TEST(TargetSurface, IsWrittenAndReadWithoutMaterials)
{
    const TempFolder folder;
    Surface surface = surfaceOfHeight(ramp());
    surface.parts = {"left", "right"};
    surface.labels[3] = 1;
    saveSurface(folder / "t.nacre", surface, false);
    const Surface read = loadSurface(folder / "t.nacre");
    EXPECT_EQ(read.parts, surface.parts);
    EXPECT_EQ(read.labels, surface.labels);
    EXPECT_EQ(read.height.values, surface.height.values);
    EXPECT_TRUE(read.materials.empty());
}

TEST(TargetSurface, DamagedHeightsAndLabelsAreRefused)
{
    const TempFolder folder;
    Surface surface = surfaceOfHeight(ramp());
    saveSurface(folder / "t.nacre", surface, false);
    Image height = surface.height;
    height.values[7] = std::numeric_limits<float>::quiet_NaN();
    saveImage(folder / "t.nacre/height.exr", height, PixelType::float32);
    expectError([&] { loadSurface(folder / "t.nacre"); }, {"height.exr", "no number"});
    saveImage(folder / "t.nacre/height.exr", Image(3, 3, 1), PixelType::float32);
    expectError([&] { loadSurface(folder / "t.nacre"); }, {"height.exr", "is 3x3"});
    surface.labels[3] = 1;
    saveSurface(folder / "u.nacre", surface, false);
    expectError([&] { loadSurface(folder / "u.nacre"); }, {"labels.png", "names part 1", "below 1"});
}

TEST(TargetSurface, HeightsShrinkWithThePicture)
{
    const Surface surface = surfaceOfHeight(ramp());
    const Surface twice = fittedSurface(surface, 2 * kSize, 2 * kSize);
    EXPECT_FLOAT_EQ(twice.height.at(100, 40), 2 * surface.height.at(50, 20));
}

TEST(TargetSurface, AnAcquiredOnesMaterialsBecomeNames)
{
    Surface acquired = surfaceOfHeight(ramp());
    acquired.parts.clear();
    acquired.height = Image();
    acquired.materials.resize(1);
    acquired.materials[0].name = "clay";
    const IntegratedSurface target = surfaceWithoutMaterials(acquired);
    EXPECT_TRUE(target.surface.materials.empty());
    EXPECT_EQ(target.surface.parts, std::vector<std::string>{"clay"});
    EXPECT_EQ(target.surface.labels, acquired.labels);
    EXPECT_NEAR(target.surface.height.at(kSize - 1, 0) - target.surface.height.at(0, kSize - 1), 1, 0.01);
}

} // namespace
} // namespace nacre::test
