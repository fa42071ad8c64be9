#include "acquisition/brdf/cornell_samples.h"

#include <gtest/gtest.h>

#include "acquisition/brdf/interpolation.h"
#include "engine/brdf/brdf_comparison.h"
#include "tests/support/data_folder.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

const std::string kHeader = "# Cornell University, Program of Computer Graphics\n# A paint\n#\n# num wls\n3\n\n"
                            "# wls\n400 550\n700\n\n";

TEST(CornellSamples, ReadsAnglesAndSpectra)
{
    const TempFolder folder;
    writeText(folder / "a.brdf", kHeader + "0.5 0.0 0.5 3.14159265 0.2 0.2 0.2\r\n0.1 0.0 1.2 -1.0 0.4 0.4 0.4\n");
    const CornellMeasurements m = loadCornellMeasurements(folder / "a.brdf");
    EXPECT_EQ(m.name, "A paint");
    ASSERT_EQ(m.values.size(), 2u);
    EXPECT_NEAR(m.values[0].y, 0.2f, 1e-6f);
    EXPECT_NEAR(m.values[1].z, 0.4f, 1e-6f);
    EXPECT_EQ(m.clipped, 0u);
    const BrdfSamples samples = samplesOf(m, [](size_t) { return true; });
    // The first is the mirror's direction: thetaH = 0, thetaD = thetaI.
    EXPECT_NEAR(samples.unit[0].x, 0, 1e-3);
    EXPECT_NEAR(samples.unit[0].y, 0.5 / (M_PI / 2), 1e-5);
    EXPECT_NEAR(m.directions[1].v.z, std::cos(1.2), 1e-6);
}

TEST(CornellSamples, RefusesByName)
{
    const TempFolder folder;
    const auto expectRefused = [&](const std::string& text, const std::string& fragment) {
        writeText(folder / "a.brdf", text);
        expectError([&] { loadCornellMeasurements(folder / "a.brdf"); }, {"a.brdf", fragment});
    };
    expectRefused("", "no measurement");
    expectRefused("#\n# \n", "no measurement");
    expectRefused(kHeader, "no measurement");
    expectRefused("1 2 3\n", "line 1 is no number of wavelengths");
    expectRefused("2\n400 500 700\n", "lists 3 wavelengths");
    expectRefused("2\n450 700\n", "from 450 to 700");
    expectRefused("3\n400 300 700\n", "from 400 to 700");
    expectRefused(kHeader + "0.5 0 0.5 0 0.2 0.2\n", "line 11 has 6 numbers");
    expectRefused(kHeader + "0.5 0 0.5 0 0.2 x 0.2\n", "\"x\" is no number");
    expectRefused(kHeader + "0.5 0 0.5 0 0.2 nan 0.2\n", "\"nan\" is no number");
    expectRefused(kHeader + "1.9 0 0.5 0 0.2 0.2 0.2\n", "polar angle 1.9");
    expectError([&] { loadCornellMeasurements(folder / "none.brdf"); }, {"none.brdf", "cannot be read"});
}

TEST(CornellSamples, KeepsFourOfFive)
{
    size_t kept = 0;
    for (size_t i = 0; i < 10000; ++i) {
        kept += isKeptOfFive(i);
    }
    EXPECT_NEAR(static_cast<double>(kept), 8000, 120); // three standard deviations
}

// The property of any interpolant worth its name: four fifths of the measurements predict the last fifth.
TEST(CornellSamples, FourFifthsPredictTheRest)
{
    NACRE_REQUIRE_DATA("measured");
    for (const std::string name : {"garnet_red", "krylon_blue"}) {
        const CornellMeasurements m = loadCornellMeasurements(dataFolder() / "measured" / (name + ".brdf"));
        ASSERT_EQ(m.values.size(), 1439u);
        const BrdfSamples heldOut = samplesOf(m, [](size_t i) { return !isKeptOfFive(i); });
        const BrdfInterpolant interpolant = makeInterpolant(samplesOf(m, isKeptOfFive), {});
        std::vector<glm::vec3> predicted;
        for (const glm::vec3& unit : heldOut.unit) {
            predicted.push_back(interpolant(unit).value);
        }
        const BrdfComparison c = compareValues(predicted, heldOut.values);
        // 33 and 29 dB were reached; nearest-sample lookup alone gives less than 24.
        EXPECT_GT(c.psnr, 26) << name;
        EXPECT_LT(c.percentile95, 0.12) << name;
    }
}

} // namespace
} // namespace nacre
