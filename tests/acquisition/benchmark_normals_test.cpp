// Real photographs with published figures.
#include <gtest/gtest.h>

#include "acquisition/capture/capture_maps.h"
#include "acquisition/chain/acquire.h"
#include "acquisition/lights/sphere_outline.h"
#include "engine/files/measures.h"
#include "tests/support/data_folder.h"

namespace nacre {
namespace {

double meanError(const std::string& object, NormalMethod method)
{
    const Capture capture = loadCapture(dataFolder() / "diligent" / object);
    EXPECT_EQ(capture.truthNormals.filename(), "Normal_gt.mat");
    AcquireOptions options;
    options.normals.method = method;
    const NormalEstimate estimate = estimateCaptureNormals(capture, options, [](const std::string&, double) {});
    return angularError(estimate.normals, loadTrueNormals(capture.truthNormals), capture.mask).mean;
}

// Shi et al., A Benchmark Dataset and Evaluation for Non-Lambertian and Uncalibrated Photometric Stereo, 2019: least
// squares has 4.10 degrees on ball and 8.39 on bear. Theirs clips observations at 1 and takes them for data; here what
// the sensor clipped is no data: ball, whose highlights are clipped, gains a third of a degree, bear differs by 0.1.
TEST(DiligentDataSlow, LeastSquaresReproducesThePublishedErrors)
{
    NACRE_REQUIRE_DATA("diligent");
    EXPECT_NEAR(meanError("ballPNG", NormalMethod::leastSquares), 3.78, 0.1);
    EXPECT_NEAR(meanError("bearPNG", NormalMethod::leastSquares), 8.39, 0.1);
}

TEST(DiligentDataSlow, RobustNormalsHoldTheirFigures)
{
    NACRE_REQUIRE_DATA("diligent");
    EXPECT_LE(meanError("ballPNG", NormalMethod::consensus), 1.96);
    EXPECT_LE(meanError("bearPNG", NormalMethod::consensus), 5.2);
    EXPECT_LE(meanError("ballPNG", NormalMethod::automatic), 1.5);
    EXPECT_LE(meanError("bearPNG", NormalMethod::automatic), 4.6);
    EXPECT_LE(meanError("readingPNG", NormalMethod::automatic), 10.8);
}

TEST(DiligentDataSlow, TruthIsTheSameAsMatlabAndAsPicture)
{
    NACRE_REQUIRE_DATA("diligent");
    const std::filesystem::path folder = dataFolder() / "diligent" / "ballPNG";
    const NormalMap matlab = loadTrueNormals(folder / "Normal_gt.mat"),
                    picture = loadTrueNormals(folder / "Normal_gt.png");
    const Capture capture = loadCapture(folder);
    // 16 bits resolve 3e-5 of a component.
    EXPECT_LT(angularError(picture, matlab, capture.mask).percentile95, 0.01);
    EXPECT_EQ(angularError(picture, matlab, capture.mask).missing, 0u);
}

Rig chromeRig(const char* object)
{
    CaptureOptions options;
    options.mirrorSphere = dataFolder() / "psm" / "chrome";
    options.diffuseSphere = dataFolder() / "psm" / "gray";
    return calibrateLights(loadCapture(dataFolder() / "psm" / object, options));
}

TEST(PsmData, ChromeAndGrayCalibrateTwelveLights)
{
    NACRE_REQUIRE_DATA("psm");
    const Rig rig = chromeRig("horse");
    ASSERT_EQ(rig.lights.size(), 12u);
    double disagreement = 0;
    for (size_t i = 0; i < rig.lights.size(); ++i) {
        EXPECT_GE(rig.lights[i].direction.z, 0.7f);
        EXPECT_LE(rig.lights[i].direction.z, 1.0f);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(rig.lights[i].irradiance[c], 1, 0.03);
        }
        disagreement += rig.shadingDisagreement[i] / 12;
    }
    EXPECT_LT(disagreement, 3.5);
}

// The gray sphere under chrome's lights against its own geometry, a record of what stands: half of it is within 4
// degrees, the mean is not, for which the outer tenth of the radius accounts most.
TEST(PsmData, GraySphereHasNormalsOfASphere)
{
    NACRE_REQUIRE_DATA("psm");
    CaptureOptions spheres;
    spheres.mirrorSphere = dataFolder() / "psm" / "chrome";
    spheres.diffuseSphere = dataFolder() / "psm" / "gray";
    const Capture capture = loadCapture(dataFolder() / "psm" / "gray", spheres);
    AcquireOptions options;
    options.normals.method = NormalMethod::consensus;
    const NormalEstimate estimate = estimateCaptureNormals(capture, options, [](const std::string&, double) {});
    const Circle outline = fitCircle(capture.mask, capture.width, capture.height, capture.folder);
    const AngularError error =
        angularError(estimate.normals, sphereNormals(outline, capture.width, capture.height), capture.mask);
    EXPECT_LT(error.median, 4);
    EXPECT_LT(error.mean, 5.8);
}

} // namespace
} // namespace nacre
