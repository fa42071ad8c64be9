#include <cmath>

#include <gtest/gtest.h>

#include "acquisition/capture/capture.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/support/write_capture.h"

namespace nacre {
namespace {

class CaptureDiligent : public testing::Test {
protected:
    CaptureDiligent() { writeDiligentFolder(folder_.path(), 11); }
    Capture load() { return loadCapture(folder_.path()); }
    void expectRefused(const std::vector<std::string>& fragments)
    {
        expectError([&] { load(); }, fragments);
    }
    TempFolder folder_;
};

TEST_F(CaptureDiligent, IsFoundWithLightsAndMask)
{
    const Capture capture = load();
    EXPECT_EQ(capture.layout, CaptureLayout::diligent);
    EXPECT_EQ(capture.name, folder_.path().filename());
    ASSERT_EQ(capture.photographs.size(), 11u);
    ASSERT_EQ(capture.lights.size(), 11u);
    EXPECT_EQ(capture.photographs[9].name, "010.png");
    EXPECT_EQ(capture.lights[9].irradiance, glm::vec3(10, 20, 30));
    EXPECT_NEAR(capture.lights[0].direction.z, std::sqrt(0.75f), 1e-6f); // directionLines
    EXPECT_TRUE(capture.irradianceGiven);
    EXPECT_EQ(capture.lightsSource, (folder_ / "light_directions.txt").string());
    EXPECT_EQ(capture.maskPixels, size_t{6} * kTestHeight);
    EXPECT_TRUE(capture.truthNormals.empty());
}

TEST_F(CaptureDiligent, PhotographsComeInTheOrderListed)
{
    writeText(folder_ / "filenames.txt", "\xef\xbb\xbf"
                                         "002.png\r\nwith space.png \r\n\r\n001.png\r\n");
    writeText(folder_ / "light_directions.txt", directionLines(3));
    writeText(folder_ / "light_intensities.txt", "1 1 1\n1 1 1\n1 1 1\n");
    writePicture(folder_ / "with space.png", 3);
    const Capture capture = load();
    EXPECT_EQ(capture.photographs[0].name, "002.png");
    EXPECT_EQ(capture.photographs[1].name, "with space.png");
    EXPECT_EQ(capture.photographs[2].name, "001.png");
}

TEST_F(CaptureDiligent, NamesMayDifferInCase)
{
    std::filesystem::rename(folder_ / "filenames.txt", folder_ / "Filenames.TXT");
    std::filesystem::rename(folder_ / "light_directions.txt", folder_ / "Light_Directions.txt");
    std::filesystem::rename(folder_ / "002.png", folder_ / "002.PNG");
    const Capture capture = load();
    EXPECT_EQ(capture.photographs[1].name, "002.PNG");
    EXPECT_EQ(capture.lights.size(), 11u);
}

TEST_F(CaptureDiligent, TruthIsTheUnroundedOne)
{
    writePicture(folder_ / "Normal_gt.png", 1);
    EXPECT_EQ(load().truthNormals, folder_ / "Normal_gt.png");
    writeText(folder_ / "Normal_gt.mat", "");
    EXPECT_EQ(load().truthNormals, folder_ / "Normal_gt.mat");
}

TEST_F(CaptureDiligent, WithoutIntensitiesTheIrradianceIsNotGiven)
{
    std::filesystem::remove(folder_ / "light_intensities.txt");
    const Capture capture = load();
    EXPECT_FALSE(capture.irradianceGiven);
    EXPECT_EQ(capture.lights[5].irradiance, glm::vec3(1));
}

TEST_F(CaptureDiligent, CountsHaveToAgree)
{
    writeText(folder_ / "light_directions.txt", directionLines(10));
    expectRefused({"light_intensities.txt", "11 lights", "10 directions"});
    writeText(folder_ / "light_intensities.txt",
              "1 1 1\n1 1 1\n1 1 1\n1 1 1\n1 1 1\n1 1 1\n1 1 1\n1 1 1\n1 1 1\n1 1 1\n");
    expectRefused({"light_directions.txt", "10 lights", "filenames.txt has 11 photographs"});
}

TEST_F(CaptureDiligent, ListedPhotographHasToBeThere)
{
    std::filesystem::remove(folder_ / "007.png");
    expectRefused({"007.png", "does not exist", "filenames.txt"});
}

} // namespace
} // namespace nacre
