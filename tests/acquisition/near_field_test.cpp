// Near lights and a camera with a lens: geometry by hand, photographs turned into those of distant lights, heights
// through a lens, and the chain on captures whose truth is known.
#include <cmath>
#include <fstream>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/capture/capture_maps.h"
#include "acquisition/chain/acquire.h"
#include "acquisition/near_field/as_if_distant.h"
#include "assets/synth/synth_capture.h"
#include "engine/files/measures.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

const Progress kSilent = [](const std::string&, double) {};

NearField fieldOf(const glm::vec3& light, double cameraDistance)
{
    return {{light}, cameraDistance, {50, 50}, {50, 50}};
}

TEST(NearField, PointsHaveThePlacesAndFramesOfTheirRays)
{
    const NearField far = fieldOf({0, 0, 100}, std::numeric_limits<double>::infinity());
    const LocalFrame straight = frameAt(far, 20 * 100 + 70, 100, 3);
    EXPECT_EQ(straight.place, glm::vec3(20.5f, 29.5f, 3));
    EXPECT_EQ(straight.toLocal, glm::mat3(1));
    // The camera stands 200 above the middle: at a height of 20 a ray is a tenth nearer to the axis.
    const LocalFrame slanted = frameAt(fieldOf({0, 0, 100}, 200), 20 * 100 + 70, 100, 20);
    EXPECT_NEAR(slanted.place.x, 20.5f * 0.9f, 1e-4f);
    EXPECT_NEAR(slanted.place.y, 29.5f * 0.9f, 1e-4f);
    const glm::vec3 view = glm::normalize(glm::vec3(0, 0, 200) - slanted.place);
    EXPECT_NEAR(glm::distance(slanted.toLocal * view, glm::vec3(0, 0, 1)), 0, 1e-6);
    const glm::vec3 v(0.3f, -0.2f, 0.5f);
    EXPECT_NEAR(glm::length(slanted.toLocal * v), glm::length(v), 1e-6);
}

TEST(NearField, LightFallsOffWithTheSquareOfItsDistance)
{
    const NearField near = fieldOf({0, 0, 100}, std::numeric_limits<double>::infinity());
    LocalFrame frame;
    frame.place = {0, 0, 50};
    EXPECT_FLOAT_EQ(lightAt(near, frame, {{0, 0, 1}, {1, 2, 3}}, 0).irradiance.y, 8);
    frame.place = {100, 0, 0};
    const Light aside = lightAt(near, frame, {{0, 0, 1}, {1, 2, 3}}, 0);
    EXPECT_FLOAT_EQ(aside.irradiance.x, 0.5f);
    EXPECT_NEAR(glm::distance(aside.direction, glm::vec3(-1, 0, 1) / std::sqrt(2.0f)), 0, 1e-6);
}

// A matt sphere before near lights and through a lens, without noise.
SynthOptions nearSphere()
{
    SynthOptions options;
    options.shape = SynthShape::sphere;
    options.width = options.height = 64;
    options.lights = 12;
    options.material = "lambert:0.5,0.4,0.3";
    options.noise = 0;
    options.lightDistance = 3;
    options.fieldOfView = 20;
    return options;
}

NearField fieldOf(const SynthScene& scene)
{
    const double halfSide = scene.options.width / 2.0;
    NearField near;
    near.cameraDistance = scene.view.cameraDistance * halfSide;
    near.axis = glm::dvec2(halfSide);
    near.origin = halfSide * (glm::dvec2(1) + glm::dvec2(scene.middle.x, -scene.middle.y));
    for (const Light& light : scene.lights) {
        near.lights.push_back(static_cast<float>(scene.lightDistance * halfSide) * light.direction);
    }
    return near;
}

Image trueHeight(const SynthScene& scene)
{
    Image height(scene.options.width, scene.options.height, 1);
    for (const uint32_t pixel : scene.view.seen) {
        height.values[pixel] = static_cast<float>(scene.view.depth[pixel] * scene.options.width / 2.0);
    }
    return height;
}

TEST(NearField, PhotographsBecomeThoseOfDistantLights)
{
    const SynthScene scene = makeSynthScene(nearSphere());
    const LocalLights lights(scene.lights, fieldOf(scene), trueHeight(scene), scene.options.width);
    Observations block;
    block.width = scene.options.width;
    block.lightCount = scene.lights.size();
    block.pixels = scene.view.seen;
    block.radiance.resize(block.pixels.size() * block.lightCount);
    block.saturated.assign(block.radiance.size(), 0);
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const Image photograph = objectRadiance(scene, scene.lights[i], 1);
        for (size_t p = 0; p < block.pixels.size(); ++p) {
            const int x = static_cast<int>(block.pixels[p]) % block.width,
                      y = static_cast<int>(block.pixels[p]) / block.width;
            block.radiance[p * block.lightCount + i] = photograph.rgb(x, y);
        }
    }
    const std::vector<glm::vec3> normals = localNormals(block, lights, scene.view.normals);
    const Observations distant = asIfDistant(block, lights, normals, 2);
    size_t compared = 0;
    for (size_t p = 0; p < block.pixels.size(); ++p) {
        for (size_t i = 0; i < block.lightCount; ++i) {
            const float cosine = glm::dot(normals[p], scene.lights[i].direction);
            if (cosine > 0.2f && !distant.saturated[p * block.lightCount + i] &&
                block.radiance[p * block.lightCount + i].x > 0) {
                const float lambert = 0.5f / static_cast<float>(kPi) * scene.lights[i].irradiance.x * cosine;
                EXPECT_NEAR(distant.radiance[p * block.lightCount + i].x / lambert, 1, 2e-4);
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 8 * block.pixels.size()); // of 12 lights
}

// How the distances from the camera's plane to two surfaces differ in ratio over the sphere's front: a surface through
// a lens is known up to its scale.
double ratioSpread(const SynthScene& scene, double distance, const Image& found, const Image& truth)
{
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const uint32_t pixel : scene.view.seen) {
        if (scene.view.normals.normals[pixel].z > 0.6f) {
            const double ratio = (distance - found.values[pixel]) / (distance - truth.values[pixel]);
            least = std::min(least, ratio);
            most = std::max(most, ratio);
        }
    }
    return most / least - 1;
}

TEST(NearField, ASphereThroughALensHasItsHeight)
{
    SynthOptions options = nearSphere();
    options.width = options.height = 128;
    options.fieldOfView = 40;
    const SynthScene scene = makeSynthScene(options);
    const NearField near = fieldOf(scene);
    NearField without = near;
    without.cameraDistance = std::numeric_limits<double>::infinity();
    const Image truth = trueHeight(scene);
    const auto spreadOf = [&](const NearField& camera) {
        return ratioSpread(scene, near.cameraDistance, heightBefore(scene.view.normals, camera, 1), truth);
    };
    EXPECT_LT(spreadOf(near), 0.003); // half a pixel of 176, integration's own error
    EXPECT_GT(spreadOf(without), 0.01);
}

AcquireOptions seekingDistance()
{
    AcquireOptions options;
    options.estimateDistance = true;
    return options;
}

double meanError(const Capture& capture, std::vector<Finding>& findings)
{
    const NormalEstimate estimate = estimateCaptureNormals(capture, seekingDistance(), kSilent);
    findings = estimate.report.findings;
    const NormalMap truth = windowedNormals(loadTrueNormals(capture.truthNormals), capture, capture.truthNormals);
    return angularError(estimate.normals, truth, capture.mask).mean;
}

// Lamps at three widths, whose places are given.
SynthOptions nearCapture()
{
    SynthOptions options;
    options.width = options.height = 96;
    options.lights = 20;
    options.lightDistance = 3;
    options.giveLights = true;
    options.sphereSize = 48; // not looked at
    return options;
}

TEST(NearFieldSlow, TheChainFindsNormalsUnderNearLights)
{
    const TempFolder folder;
    SynthOptions options = nearCapture();
    options.fieldOfView = 20;
    writeSynthCapture(folder / "c", makeSynthScene(options), false);
    const Capture given = loadCapture(folder / "c");
    CaptureOptions far;
    far.lightDistance = std::numeric_limits<double>::infinity();
    Capture distant = loadCapture(folder / "c", far);
    distant.fieldOfView.reset();
    Capture unplaced = loadCapture(folder / "c");
    unplaced.lightPlaces.clear();
    std::vector<Finding> findings;
    EXPECT_GT(meanError(distant, findings), 4.5);
    // Of 5 degrees a rim whose height the normals tell too low leaves less than 2.
    EXPECT_LT(meanError(given, findings), 2.2);
    EXPECT_LT(meanError(unplaced, findings), 2.6);
    EXPECT_TRUE(contains(findings, FindingCode::lightsPlaced));
    EXPECT_FALSE(contains(findings, FindingCode::lightsNear));
}

TEST(NearFieldSlow, TheChainRelightsUnderNearLights)
{
    const TempFolder folder;
    writeSynthCapture(folder / "c", makeSynthScene(nearCapture()), false);
    AcquireOptions acquiring;
    acquiring.residual.choice = ResidualChoice::automatic;
    acquiring.castShadows = true;
    CaptureOptions far;
    far.lightDistance = std::numeric_limits<double>::infinity();
    const Acquisition placed = acquire(loadCapture(folder / "c"), acquiring, kSilent),
                      distant = acquire(loadCapture(folder / "c", far), acquiring, kSilent);
    EXPECT_NEAR(placed.surface.lights[7].light.distance, 3, 0.3);
    EXPECT_FALSE(placed.surface.height.values.empty());
    const Capture capture = loadCapture(folder / "c");
    const NormalMap truth = windowedNormals(loadTrueNormals(capture.truthNormals), capture, capture.truthNormals);
    // 1.1; 2.5 where each guess is the last one's answer, and swings.
    EXPECT_LT(angularError(placed.surface.normals, truth, capture.mask).mean, 1.6);
    EXPECT_EQ(distant.surface.lights[7].light.distance, std::numeric_limits<float>::infinity());
    // Of lights left out, by the BRDF alone.
    EXPECT_GT(placed.residual.fit.brdfPsnr, distant.residual.fit.brdfPsnr + 2);
    EXPECT_TRUE(placed.surface.castsShadows);
    EXPECT_GT(placed.shadows.shadowedPsnr, placed.shadows.psnr + 1);
}

TEST(NearFieldSlow, TheChainRelightsThroughALens)
{
    const TempFolder folder;
    SynthOptions options = nearCapture();
    options.shape = SynthShape::sphere;
    options.lightDistance = 0;
    options.fieldOfView = 30;
    options.material = SynthOptions().material; // glossy
    writeSynthCapture(folder / "c", makeSynthScene(options), false);
    AcquireOptions acquiring;
    acquiring.residual.choice = ResidualChoice::automatic;
    const Acquisition lens = acquire(loadCapture(folder / "c"), acquiring, kSilent);
    ASSERT_TRUE(lens.surface.camera);
    EXPECT_NEAR(lens.surface.camera->z * extentOf(lens.surface.normals).width, 48 / std::tan(glm::radians(15.0)), 2);
    // 34 dB where each pixel is drawn as if it were seen along z.
    EXPECT_GT(lens.residual.fit.brdfPsnr, 38);
}

TEST(NearField, DistantLightsStayDistant)
{
    const TempFolder folder;
    SynthOptions options;
    options.width = options.height = 64;
    options.giveLights = true;
    options.sphereSize = 48;
    writeSynthCapture(folder / "c", makeSynthScene(options), false);
    const Capture capture = loadCapture(folder / "c");
    EXPECT_FALSE(nearFieldOf(capture, {0}, {capture.lights[0]}));
    Capture harmless = capture;
    harmless.lightDistance = 100; // widths: directions turn by 0.3 degrees
    EXPECT_FALSE(nearFieldOf(harmless, {0}, {capture.lights[0]}));
    harmless.lightDistance = 20;
    EXPECT_TRUE(nearFieldOf(harmless, {0}, {capture.lights[0]}));
    const NormalEstimate estimate = estimateCaptureNormals(capture, seekingDistance(), kSilent);
    EXPECT_FALSE(contains(estimate.report.findings, FindingCode::lightsPlaced));
}

SynthOptions fourLights()
{
    SynthOptions options;
    options.width = options.height = 32;
    options.lights = 4;
    options.giveLights = true;
    options.sphereSize = 48;
    return options;
}

TEST(NearField, TheCameraLooksAtTheFilesMiddleHoweverTheyAreCut)
{
    Capture whole;
    whole.width = 200;
    whole.height = 100;
    whole.mask.assign(200 * 100, 1);
    whole.fieldOfView = 30;
    Capture part = whole;
    part.window = {40, 10, 120, 60, 2, 200, 100};
    part.width = 60;
    part.height = 30;
    part.mask.assign(60 * 30, 1);
    const NearField ofWhole = cameraOf(whole), ofPart = cameraOf(part);
    EXPECT_NEAR(ofPart.cameraDistance, ofWhole.cameraDistance / 2, 1e-9);
    EXPECT_NEAR(2 * ofPart.axis.x + 40, ofWhole.axis.x, 1e-9);
    EXPECT_NEAR(2 * ofPart.axis.y + 10, ofWhole.axis.y, 1e-9);
}

TEST(NearField, PlacesThatNoLampHasAreRefused)
{
    const TempFolder folder;
    SynthOptions options = fourLights();
    options.lightDistance = 3;
    writeSynthCapture(folder / "c", makeSynthScene(options), false);
    const Capture capture = loadCapture(folder / "c");
    const std::vector<size_t> all{0, 1, 2, 3};
    EXPECT_TRUE(nearFieldOf(capture, all, capture.lights));
    Capture behind = capture;
    behind.lightPlaces[2].z = -0.5f;
    expectError([&] { nearFieldOf(behind, all, behind.lights); }, {"object_03.png", "0.50 widths behind", "z towards"});
    CaptureOptions millimetres; // and places in metres are inside
    millimetres.objectWidth = 1000;
    const Capture small = loadCapture(folder / "c", millimetres);
    expectError([&] { nearFieldOf(small, all, small.lights); }, {"object_01.png", "inside", "unit of the object's"});
    CaptureOptions metres;
    metres.objectWidth = 0.001;
    const Capture large = loadCapture(folder / "c", metres);
    expectError([&] { nearFieldOf(large, all, large.lights); },
                {"object_01.png", "3000 widths", "unit of the object's"});
}

// As two mirror spheres or a rig place them.
TEST(NearField, LightsBringTheirOwnDistances)
{
    const TempFolder folder;
    writeSynthCapture(folder / "c", makeSynthScene(fourLights()), false);
    Capture capture = loadCapture(folder / "c");
    capture.lightPlaces.clear();
    for (size_t i = 0; i < capture.lights.size(); ++i) {
        capture.lights[i].distance = 2 + static_cast<float>(i);
    }
    const std::vector<size_t> all{0, 1, 2, 3};
    std::optional<NearField> near = nearFieldOf(capture, all, capture.lights);
    ASSERT_TRUE(near);
    const float width = static_cast<float>(extentOf(capture).width);
    EXPECT_NEAR(glm::distance(near->lights[3], 5 * width * capture.lights[3].direction), 0, 1e-3f * width);
    near->depth = 0.5 * width; // found later
    const Light placed = placedLights(capture, all, capture.lights, near)[3];
    EXPECT_NEAR(
        glm::distance(placed.distance * placed.direction, 5.0f * capture.lights[3].direction + glm::vec3(0, 0, 0.5f)),
        0, 1e-5);
    capture.lights[2].distance = 0.3f;
    expectError([&] { nearFieldOf(capture, all, capture.lights); }, {"0.30 widths", "inside"});
}

TEST(NearField, LightsInsideTheObjectAndDirectionsForPlacesAreRefused)
{
    const TempFolder folder;
    writeSynthCapture(folder / "c", makeSynthScene(fourLights()), false);
    CaptureOptions width;
    width.objectWidth = 0.2;
    expectError([&] { loadCapture(folder / "c", width); }, {"places no lights", "0.2", "places in the unit"});
    CaptureOptions inside;
    inside.lightDistance = 0.4;
    const Capture capture = loadCapture(folder / "c", inside);
    expectError(
        [&] {
            nearFieldOf(capture, {0, 1, 2, 3}, capture.lights);
        },
        {"object_01.png", "0.40 widths", "inside"});
}

} // namespace
} // namespace nacre
