// The chain on captures whose truth is known.
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/capture/capture_maps.h"
#include "acquisition/chain/acquire.h"
#include "assets/synth/synth_capture.h"
#include "engine/files/measures.h"
#include "engine/lights/light_files.h"
#include "engine/scene/reference.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

const Progress kNoProgress = [](const std::string&, double) {};

Capture writeAndLoad(const TempFolder& folder, const SynthOptions& options)
{
    writeSynthCapture(folder / "capture", makeSynthScene(options), false);
    return loadCapture(folder / "capture");
}

SynthOptions exactSphere()
{
    SynthOptions options;
    options.shape = SynthShape::sphere;
    options.width = options.height = 96;
    options.material = "lambert:0.6,0.5,0.4";
    options.noise = 0;
    options.format = SynthFormat::exr;
    options.giveLights = true;
    options.sphereSize = 48; // not looked at
    return options;
}

TEST(SyntheticChain, LambertianSphereGivesNormalsWithin0Point05DegreesAndAlbedoWithinHalfAPercent)
{
    const TempFolder folder;
    const Capture capture = writeAndLoad(folder, exactSphere());
    AcquireOptions options;
    options.normals.method = NormalMethod::threshold;
    options.normals.lowThreshold = 1e-4f; // drops attached shadows and nothing else
    options.normals.highThreshold = 1e6f;
    const NormalMap truth = loadTrueNormals(capture.truthNormals);
    ObservationReader reader(capture);
    Observations block;
    ASSERT_TRUE(reader.next(block));
    const std::vector<PixelNormal> normals =
        makeThresholdEstimator(capture.lights, options.normals)(intensitiesOf(block, capture.lights)).pixels;
    // One radiance scale for the whole capture: albedo is compared with its own median.
    std::vector<float> albedos;
    size_t compared = 0;
    for (size_t p = 0; p < normals.size(); ++p) {
        if (normals[p].used >= 3 && normals[p].confidence > 0) {
            ++compared;
            EXPECT_LT(degreesBetween(normals[p].normal, truth.normals[block.pixels[p]]), 0.05);
            albedos.push_back(normals[p].albedo);
        }
    }
    EXPECT_GT(compared, block.pixels.size() * 95 / 100);
    const float median = quantile(albedos, 0.5);
    for (const float albedo : albedos) {
        EXPECT_NEAR(albedo / median, 1, 0.005);
    }
}

TEST(SyntheticChain, SpheresCalibrateLightsWithin0Point3DegreesAndIntensitiesWithinHalfAPercent)
{
    const TempFolder folder;
    SynthOptions options;
    options.width = options.height = 64;
    const Capture capture = writeAndLoad(folder, options);
    const Rig rig = calibrateLights(capture);
    const std::vector<Light> truth = loadLightFile(folder / "capture" / "truth" / "lights.json").lights;
    ASSERT_EQ(rig.lights.size(), truth.size());
    glm::dvec3 sum(0), trueSum(0);
    for (size_t i = 0; i < truth.size(); ++i) {
        sum += glm::dvec3(rig.lights[i].irradiance);
        trueSum += glm::dvec3(truth[i].irradiance);
    }
    const double scale = (sum.x + sum.y + sum.z) / (trueSum.x + trueSum.y + trueSum.z); // one factor per capture
    for (size_t i = 0; i < truth.size(); ++i) {
        EXPECT_LT(degreesBetween(rig.lights[i].direction, truth[i].direction), 0.3) << "light " << i;
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(rig.lights[i].irradiance[c] / (scale * truth[i].irradiance[c]), 1, 0.005) << "light " << i;
        }
    }
}

// Multiplies what a sphere's photographs show by 1 + share (n.l - n.v), whose sign changes where l and v change places.
void breakReciprocity(const Capture& capture, float share)
{
    const NormalMap truth = loadTrueNormals(capture.truthNormals);
    for (size_t i = 0; i < capture.photographs.size(); ++i) {
        Image picture = loadImage(capture.photographs[i].exposures.front().file);
        for (size_t p = 0; p < truth.normals.size(); ++p) {
            const glm::vec3& n = truth.normals[p];
            const float factor = 1 + share * (glm::dot(n, capture.lights[i].direction) - n.z);
            for (int c = 0; c < 3; ++c) {
                picture.values[p * static_cast<size_t>(picture.channels) + static_cast<size_t>(c)] *= factor;
            }
        }
        saveImage(capture.photographs[i].exposures.front().file, picture, PixelType::float32);
    }
}

TEST(SyntheticChainSlow, OnlyABrdfThatIsNotReciprocalIsKeptOneWay)
{
    const TempFolder folder;
    SynthOptions synth = exactSphere();
    synth.width = synth.height = 64;
    const Capture capture = writeAndLoad(folder, synth);
    AcquireOptions options;
    options.castShadows = false;
    options.residual.choice = ResidualChoice::none;
    const auto expect = [&](NormalMethod method, bool isOneWay) {
        options.normals.method = method;
        const Acquisition result = acquire(capture, options, kNoProgress);
        EXPECT_EQ(result.surface.materials.front().table.domain.coordinates, isOneWay ? kOneWay : kHalfDifference);
        EXPECT_EQ(contains(result.estimate.report.findings, FindingCode::notReciprocal), isOneWay);
    };
    expect(NormalMethod::exemplar, false);
    breakReciprocity(capture, 0.5f);
    expect(NormalMethod::exemplar, true);
    expect(NormalMethod::consensus, false);
}

TEST(SyntheticChainSlow, ADiffuseSphereOfKnownReflectanceMakesTheScaleAbsolute)
{
    const TempFolder folder;
    SynthOptions synth = exactSphere();
    synth.giveLights = false;
    synth.sphereSize = 192;
    synth.width = synth.height = 128;
    const Capture capture = writeAndLoad(folder, synth);
    AcquireOptions options;
    options.calibration.sphereReflectance = synth.sphereReflectance;
    options.normals.method = NormalMethod::threshold;
    options.normals.lowThreshold = 1e-3f;
    options.normals.highThreshold = 1e6f;
    const Acquisition result = acquire(capture, options, kNoProgress);
    EXPECT_EQ(result.surface.scale, RadianceScale::absolute);
    const glm::vec3 n(0, 0, 1), l = glm::normalize(glm::vec3(0.3f, 0.2f, 0.9f));
    const glm::vec3 f = evaluateTable(result.surface.materials.front().table, n, l, n).value;
    // Albedo / pi, to the half percent of the irradiances and as much of the normals.
    EXPECT_NEAR(f.x * 3.14159265f / 0.6f, 1, 0.01);
    EXPECT_NEAR(f.z * 3.14159265f / 0.4f, 1, 0.01);
}

TEST(SyntheticChain, RenderingWithACapturedLightGivesThePhotographBack)
{
    const TempFolder folder;
    SynthOptions synth = exactSphere();
    synth.format = SynthFormat::png16;
    const Capture capture = writeAndLoad(folder, synth);
    const Acquisition result = acquire(capture, {}, kNoProgress);
    Scene scene{result.surface, {result.surface.lights[7].light}};
    const Image photograph = loadPhotograph(capture.photographs[7].exposures.front().file, capture.curve);
    std::vector<float> values = photograph.values;
    const double psnr = radiancePsnr(renderReference(scene), photograph, capture.mask, quantile(values, 0.99));
    // 16 bits, exact lights and a matt sphere: what is left is the table's grain; 30 dB is 3 % of the peak.
    EXPECT_GT(psnr, 30);
}

TEST(SyntheticChainSlow, SameBytesForOneAndTwoThreadsAndAnyBudget)
{
    const TempFolder folder;
    SynthOptions synth;
    synth.width = synth.height = 48;
    synth.lights = 12;
    synth.giveLights = true;
    synth.sphereSize = 48;
    const Capture capture = writeAndLoad(folder, synth);
    AcquireOptions one, two;
    one.setThreads(1);
    two.setThreads(2);
    one.bake.size = two.bake.size = {24, 8, 8};
    two.byteBudget = 64 << 10; // many blocks
    one.castShadows = two.castShadows = true;
    const Acquisition a = acquire(capture, one, kNoProgress), b = acquire(capture, two, kNoProgress);
    EXPECT_EQ(a.surface.normals.normals, b.surface.normals.normals);
    EXPECT_EQ(a.surface.materials[0].table.values, b.surface.materials[0].table.values);
    EXPECT_EQ(a.surface.materials[0].table.confidence, b.surface.materials[0].table.confidence);
    EXPECT_GT(a.shadows.castShare, 0);
    EXPECT_EQ(a.shadows.shadowedPsnr, b.shadows.shadowedPsnr);
    EXPECT_EQ(a.surface.height.values, b.surface.height.values);
}

} // namespace
} // namespace nacre
