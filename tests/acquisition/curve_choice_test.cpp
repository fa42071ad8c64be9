// The curve that photographs of 8 bits tell where their files declare none.
#include "acquisition/chain/capture_preparation.h"
#include "acquisition/chain/curve_choice.h"

#include <gtest/gtest.h>

#include "assets/synth/synth_capture.h"
#include "engine/lights/light_files.h"
#include "shared/shading.h"
#include "tests/support/data_folder.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

// `name` of the photographs' own extension. TIFF declares nothing and is taken for linear, JPEG for sRGB.
Capture photographsAs(const TempFolder& folder, const std::string& extension, bool encoded)
{
    SynthOptions options;
    options.shape = SynthShape::sphere;
    options.width = options.height = 64;
    options.lights = 12;
    options.giveLights = true;
    options.sphereSize = 64;
    options.leastIrradiance = options.largestIrradiance = 1;
    writeSynthCapture(folder / "c", makeSynthScene(options), true);
    const Capture truth = loadCapture(folder / "c");
    LightFile lights;
    std::filesystem::create_directories(folder / "p");
    for (size_t i = 0; i < truth.photographs.size(); ++i) {
        const std::string name = std::filesystem::path(truth.photographs[i].name).stem().string();
        Image picture = loadPhotograph(truth.photographs[i].exposures[0].file, truth.curve);
        for (float& value : picture.values) {
            value = encoded ? srgbFromLinear(value) : value;
        }
        saveImage(folder / ("p/" + name + extension), picture, PixelType::uint8);
        lights.photographs.push_back(name + extension);
        lights.lights.push_back(truth.lights[i]);
        lights.vectors.push_back(truth.lights[i].direction);
    }
    saveLpFile(folder / "p/lights.lp", lights);
    CaptureOptions capture;
    capture.mask = folder / "c/mask.png";
    return loadCapture(folder / "p", capture);
}

TEST(CurveChoiceSlow, PhotographsTellBothWays)
{
    for (const bool encoded : {false, true}) {
        const TempFolder folder;
        Capture capture = photographsAs(folder, ".tif", encoded);
        ASSERT_TRUE(capture.curveIsAssumed);
        for (const TransferCurve& assumed : {TransferCurve::linear, TransferCurve::srgb}) {
            capture.curve = assumed;
            EXPECT_EQ(withToldCurve(capture, {}).curve, encoded ? TransferCurve::srgb : TransferCurve::linear)
                << "assumed " << assumed.name;
        }
    }
}

TEST(CurveChoice, WarningsOfLambertNameAnAssumedCurveFirst)
{
    Capture capture;
    std::vector<Finding> findings = {{FindingCode::notLambertian, "gloss"}, {FindingCode::clipped, "bright"}};
    nameAssumedCurve(capture, findings);
    EXPECT_EQ(findings[0].text, "gloss");
    capture.curveIsAssumed = true;
    nameAssumedCurve(capture, findings);
    EXPECT_EQ(findings[0].text.rfind("--transfer srgb first", 0), 0u);
    EXPECT_EQ(findings[1].text, "bright");
}

std::vector<Finding> findingsOf(const Capture& capture)
{
    return estimateCaptureNormals(capture, {}, [](const std::string&, double) {}).report.findings;
}

// A diffuse that falls faster than the cosine, in linear files; and photographs that are decoded though they were
// linear.
TEST(CurveChoiceSlow, AShadingThatFallsFastIsNoCurve)
{
    NACRE_REQUIRE_DATA("found/bunny_matt");
    EXPECT_FALSE(contains(findingsOf(loadCapture(dataFolder() / "found/bunny_matt")), FindingCode::transferCurveTaken));
    CaptureOptions options;
    options.transfer = TransferCurve::srgb;
    EXPECT_TRUE(
        contains(findingsOf(loadCapture(dataFolder() / "diligent/ballPNG", options)), FindingCode::transferCurveTaken));
}

TEST(CurveChoiceSlow, OfRealCapturesIsTheRightOne)
{
    NACRE_REQUIRE_DATA("found/nike");
    for (const char* name : {"found/nike", "psm/horse"}) {
        CaptureOptions options;
        if (name[0] == 'p') {
            options.rig = dataFolder() / "psm/lights.txt";
        }
        const Capture capture = loadCapture(dataFolder() / name, options);
        EXPECT_EQ(capture.curve, TransferCurve::linear) << name;
        EXPECT_EQ(withToldCurve(capture, {}).curve, name[0] == 'p' ? TransferCurve::linear : TransferCurve::srgb)
            << name;
    }
}

} // namespace
} // namespace nacre
