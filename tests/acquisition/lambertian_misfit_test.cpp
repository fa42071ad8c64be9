// The misfit of Lambert's law, on made and on real photographs.
#include <fstream>

#include <gtest/gtest.h>

#include "acquisition/chain/acquire.h"
#include "acquisition/checks/lambertian_misfit.h"
#include "assets/synth/synth_capture.h"
#include "tests/support/data_folder.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

double misfitOf(const Capture& capture)
{
    AcquireOptions options;
    options.normals.method = NormalMethod::leastSquares;
    return estimateCaptureNormals(capture, options, [](const std::string&, double) {}).report.lambertianMisfit;
}

double misfitOfSphere(const std::string& material)
{
    const TempFolder folder;
    SynthOptions options;
    options.shape = SynthShape::sphere;
    options.width = options.height = 64;
    options.material = material;
    options.noise = 0;
    options.giveLights = true;
    options.sphereSize = 48; // not looked at
    writeSynthCapture(folder / "c", makeSynthScene(options), false);
    return misfitOf(loadCapture(folder / "c"));
}

TEST(LambertianMisfit, IsNothingForLambertAndMuchForGloss)
{
    EXPECT_LT(misfitOfSphere("lambert:0.5,0.4,0.3"), 0.001); // 16-bit codes
    EXPECT_GT(misfitOfSphere("ggx:diffuse=0.5,0.3,0.2;specular=0.04;alpha=0.2"), 0.02);
}

// Directions are given, intensities are not: they come from the object's photographs alone. The published toolbox's
// strengths make 0.55 to 1.28 of them.
TEST(PsboxDataSlow, IntensitiesComeFromThePhotographsAlone)
{
    NACRE_REQUIRE_DATA("psbox");
    const std::string data = (dataFolder() / "psbox" / "data").string();
    const TempFolder folder;
    std::ofstream json(folder / "capture.json");
    json << R"({"format": "nacre capture", "version": 1, "lights": ")" << data
         << R"(/light_directions.txt", "photographs": [)";
    for (int i = 1; i <= 12; ++i) {
        json << (i > 1 ? ", " : "") << '"' << data << "/Objects/Image_" << (i < 10 ? "0" : "") << i << ".png\"";
    }
    json << "]}";
    json.close();
    EXPECT_LT(misfitOf(loadCapture(folder.path())), 0.04);
}

} // namespace
} // namespace nacre
