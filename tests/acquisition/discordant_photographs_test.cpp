// Photographs that no intensity reconciles with the others.
#include <gtest/gtest.h>

#include "acquisition/capture/capture_maps.h"
#include "acquisition/chain/acquire.h"
#include "assets/synth/synth_capture.h"
#include "engine/files/image.h"
#include "engine/files/measures.h"
#include "tests/support/data_folder.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

class DiscordantPhotographs : public testing::Test {
protected:
    DiscordantPhotographs()
    {
        SynthOptions options;
        options.shape = SynthShape::sphere;
        options.width = options.height = 96;
        options.lights = 12;
        options.giveLights = true;
        options.sphereSize = 48; // not looked at
        writeSynthCapture(folder_ / "c", makeSynthScene(options), false);
        capture_ = loadCapture(folder_ / "c");
    }
    // The photograph's file gets what `change` makes of its pixels.
    template <class Change> void replace(size_t index, Change&& change)
    {
        const std::filesystem::path file = capture_.photographs[index].exposures[0].file;
        const Image before = loadImage(file);
        Image after = before;
        for (int y = 0; y < after.height; ++y) {
            for (int x = 0; x < after.width; ++x) {
                after.setRgb(x, y, change(before, x, y));
            }
        }
        saveImage(file, after, PixelType::uint16);
    }
    NormalEstimate estimate(bool correct = true) const
    {
        AcquireOptions options;
        options.normals.method = NormalMethod::leastSquares; // forgives nothing
        options.correctIntensities = correct;
        return estimateCaptureNormals(capture_, options, [](const std::string&, double) {});
    }
    double errorOf(const NormalEstimate& result) const
    {
        return angularError(result.normals, loadTrueNormals(capture_.truthNormals), capture_.mask).mean;
    }
    void expectLeftOut(size_t index)
    {
        const NormalEstimate with = estimate();
        ASSERT_EQ(with.leftOut, std::vector<std::string>{capture_.photographs[index].name});
        ASSERT_EQ(with.given.size(), 11u);
        EXPECT_NE(with.report.findings.at(0).text.find(with.leftOut[0]), std::string::npos);
        CaptureOptions options;
        options.skip = with.leftOut;
        const double given = errorOf(estimate(false));
        capture_ = loadCapture(folder_ / "c", options);
        // The same photographs, the same normals: leaving out is what --skip does.
        EXPECT_NEAR(errorOf(with), errorOf(estimate()), 1e-3);
        EXPECT_GT(given, 1.2 * errorOf(with)); // it did harm
    }

    TempFolder folder_;
    Capture capture_;
};

TEST_F(DiscordantPhotographs, ACleanCaptureKeepsAll)
{
    EXPECT_TRUE(estimate().leftOut.empty());
    EXPECT_EQ(estimate().given.size(), 12u);
}

TEST_F(DiscordantPhotographs, AShiftedOneIsNamedAndLeftOut)
{
    replace(4, [](const Image& image, int x, int y) { return image.rgb((x + 10) % image.width, y); });
    expectLeftOut(4);
}

TEST_F(DiscordantPhotographs, AForeignOneIsNamedAndLeftOut)
{
    // A photograph of something else: a chequered board.
    replace(7, [](const Image&, int x, int y) { return glm::vec3((x / 6 + y / 6) % 2 ? 0.5f : 0.1f); });
    expectLeftOut(7);
}

TEST_F(DiscordantPhotographs, ABlackOneIsNamedAndLeftOut)
{
    replace(2, [](const Image&, int, int) { return glm::vec3(0); });
    expectLeftOut(2);
}

TEST_F(DiscordantPhotographs, ADimmedOneIsCorrectedAndKept)
{
    replace(5, [](const Image& image, int x, int y) { return 0.6f * image.rgb(x, y); });
    EXPECT_TRUE(estimate().leftOut.empty());
}

// Without its photograph 1 buddha's photograph 2, unevenly shaded, was explained by the strength of another.
TEST(PsmData, AnUnevenlyShadedPhotographLeavesTheOthersIntensitiesAlone)
{
    NACRE_REQUIRE_DATA("psm");
    CaptureOptions given;
    given.mirrorSphere = dataFolder() / "psm" / "chrome";
    given.diffuseSphere = dataFolder() / "psm" / "gray";
    given.skip = {"buddha.1.tga"};
    const Capture capture = loadCapture(dataFolder() / "psm" / "buddha", given);
    AcquireOptions options;
    options.normals.method = NormalMethod::leastSquares;
    const auto silent = [](const std::string&, double) {};
    const NormalEstimate corrected = estimateCaptureNormals(capture, options, silent);
    options.correctIntensities = false;
    const Rig measured = estimateCaptureNormals(capture, options, silent).rig;
    for (size_t i = 0; i < corrected.given.size(); ++i) {
        EXPECT_EQ(corrected.rig.lights[i].irradiance, measured.lights[corrected.given[i]].irradiance);
    }
}

} // namespace
} // namespace nacre
