#include <gtest/gtest.h>

#include "acquisition/lights/diffuse_sphere.h"
#include "acquisition/lights/lights.h"
#include "acquisition/lights/mirror_sphere.h"
#include "engine/files/error.h"
#include "engine/files/measures.h"
#include "tests/support/sphere_picture.h"

namespace nacre {
namespace {

const Circle kCircle{101.3, 88.7, 70.4};

std::string messageOf(const std::function<void()>& action)
{
    try {
        action();
    } catch (const Error& e) {
        EXPECT_EQ(e.exitCode(), Error::kData);
        return e.what();
    }
    return "no error";
}

TEST(SphereOutline, RecoversADisc)
{
    const Circle found = fitCircle(discMask(200, 180, kCircle), 200, 180, "mask.png");
    // A border of n edge midpoints, each off by up to half a pixel, leaves about 0.3 / sqrt(n) = 0.02 pixels.
    EXPECT_NEAR(found.x, kCircle.x, 0.06);
    EXPECT_NEAR(found.y, kCircle.y, 0.06);
    EXPECT_NEAR(found.radius, kCircle.radius, 0.06);
}

TEST(SphereOutline, ForgetsAStandAndSurvivesTheFrame)
{
    std::vector<uint8_t> mask = discMask(200, 180, kCircle);
    for (int y = 150; y < 180; ++y) {
        for (int x = 90; x < 112; ++x) {
            mask[static_cast<size_t>(y) * 200 + x] = 1;
        }
    }
    const Circle stand = fitCircle(mask, 200, 180, "mask.png");
    EXPECT_NEAR(stand.radius, kCircle.radius, 0.3);
    const Circle cutCircle{60, 88, 70};
    const Circle cut = fitCircle(discMask(200, 180, cutCircle), 200, 180, "mask.png");
    EXPECT_NEAR(cut.x, 60, 0.1);
    EXPECT_NEAR(cut.radius, 70, 0.1);
}

TEST(SphereOutline, RefusesWhatIsNoDisc)
{
    std::vector<uint8_t> square(200 * 180, 0);
    for (int y = 40; y < 140; ++y) {
        for (int x = 20; x < 180; ++x) {
            square[static_cast<size_t>(y) * 200 + x] = 1;
        }
    }
    const std::string message = messageOf([&] { fitCircle(square, 200, 180, "square.png"); });
    EXPECT_NE(message.find("square.png: is no disc"), std::string::npos) << message;
    const std::vector<uint8_t> full(200 * 180, 1);
    EXPECT_NE(messageOf([&] { fitCircle(full, 200, 180, "full.png"); }).find("no disc"), std::string::npos);
}

TEST(MirrorSphere, DirectionsWithin0Point2Degrees)
{
    for (const glm::vec3 light : {glm::vec3(0, 0, 1), glm::vec3(0.4f, 0.3f, 0.87f), glm::vec3(-0.6f, 0.2f, 0.77f),
                                  glm::vec3(0.1f, -0.85f, 0.5f)}) {
        const glm::vec3 l = glm::normalize(light);
        const Image picture = spherePicture(200, 180, kCircle, mirrorShade(l, 0.03f, 5.0f));
        const glm::vec3 found = lightFromHighlight(findHighlight(picture, kCircle, "m.png"), kCircle);
        // A highlight of r = 70 pixels moves one pixel for 2 / 70 rad of the light; the centroid knows a tenth of it.
        EXPECT_LT(degreesBetween(found, l), 0.2);
    }
}

TEST(MirrorSphere, SaturationAndASecondSpotDoNotMoveIt)
{
    const glm::vec3 l = glm::normalize(glm::vec3(0.3f, 0.4f, 0.85f));
    Image picture = spherePicture(200, 180, kCircle, mirrorShade(l, 0.06f, 5.0f));
    const Image second =
        spherePicture(200, 180, kCircle, mirrorShade(glm::normalize(glm::vec3(-0.5f, -0.3f, 0.8f)), 0.02f, 5.0f));
    for (size_t i = 0; i < picture.values.size(); ++i) {
        picture.values[i] = std::min(1.0f, picture.values[i] + second.values[i]);
    }
    // Clipping at a fifth of the highlight makes its partly covered pixels as bright as its full ones.
    EXPECT_LT(degreesBetween(lightFromHighlight(findHighlight(picture, kCircle, "m.png"), kCircle), l), 0.3);
}

TEST(MirrorSphere, NamesWhatIsWrong)
{
    const Image black(200, 180, 3);
    EXPECT_NE(messageOf([&] { findHighlight(black, kCircle, "b.png"); }).find("b.png: shows no highlight"),
              std::string::npos);
    const glm::vec3 l = glm::normalize(glm::vec3(0.2f, 0.2f, 0.9f));
    const Image diffuse =
        spherePicture(200, 180, kCircle, [&](const glm::vec3& n) { return glm::vec3(std::max(0.0f, glm::dot(n, l))); });
    EXPECT_NE(messageOf([&] { findHighlight(diffuse, kCircle, "d.png"); }).find("shows no highlight"),
              std::string::npos);
    // The frame cuts the highlight: the same sphere in a picture that ends in the middle of it.
    const Image whole =
        spherePicture(200, 180, kCircle, mirrorShade(glm::normalize(glm::vec3(0.6f, 0, 0.8f)), 0.06f, 5.0f));
    const int end = static_cast<int>(findHighlight(whole, kCircle, "w.png").x);
    Image cut(end, 180, 3);
    for (int y = 0; y < 180; ++y) {
        for (int x = 0; x < end; ++x) {
            cut.setRgb(x, y, whole.rgb(x, y));
        }
    }
    EXPECT_NE(messageOf([&] { findHighlight(cut, kCircle, "c.png"); }).find("is cut"), std::string::npos);
    // The outline cuts it: a mask drawn too small.
    const Circle small{kCircle.x, kCircle.y, findHighlight(whole, kCircle, "w.png").x - kCircle.x};
    EXPECT_NE(messageOf([&] { findHighlight(whole, small, "s.png"); }).find("is cut"), std::string::npos);
}

TEST(DiffuseSphere, IntensityWithinHalfAPercentAndOffsetFound)
{
    const glm::vec3 l = glm::normalize(glm::vec3(-0.3f, 0.4f, 0.85f));
    const glm::vec3 radiance(0.6f, 0.5f, 0.4f);
    const auto shade = [&](const glm::vec3& n) { return radiance * std::max(0.0f, glm::dot(n, l)); };
    const Image picture = spherePicture(200, 180, kCircle, shade);
    const DiffuseSphereReading reading = readDiffuseSphere(picture, kCircle, l, "d.png");
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(reading.radiance[c] / radiance[c], 1, 0.005);
    }
    EXPECT_LT(degreesBetween(reading.shadingDirection, l), 0.2);
    Image raised = picture;
    for (float& value : raised.values) {
        value += 0.07f;
    }
    const DiffuseSphereReading offset = readDiffuseSphere(raised, kCircle, l, "d.png");
    EXPECT_NEAR(offset.offset, 0.07, 0.005);
    EXPECT_LT(degreesBetween(offset.shadingDirection, l), 0.3);
}

TEST(DiffuseSphere, AReflectanceThatIsNotLambertsIsNotTakenForAnOffset)
{
    // Flatter than Lambert's cosine, as rough and cheaply painted spheres are; a free offset would explain that.
    const auto pictureUnder = [](const glm::vec3& l) {
        return spherePicture(200, 180, kCircle, [=](const glm::vec3& n) {
            return glm::vec3(std::pow(std::max(0.0f, glm::dot(n, l)), 0.8f));
        });
    };
    std::vector<glm::vec3> lights = {glm::normalize(glm::vec3(0.17f, 0.05f, 1)), glm::normalize(glm::vec3(0.7f, 0, 1)),
                                     glm::normalize(glm::vec3(-0.3f, 0.6f, 1))};
    std::vector<DiffuseSphereReading> readings;
    for (const glm::vec3& l : lights) {
        readings.push_back(readDiffuseSphere(pictureUnder(l), kCircle, l, "d.png"));
    }
    // The first light leaves no shadow in sight: alone, its photograph is explained by an offset that is not there.
    EXPECT_GT(readings[0].offset, 0.05);
    shareOffset(readings);
    EXPECT_NEAR(readings[0].offset, 0, 1e-4);
    // What the curve itself, steeper near the terminator, does to a linear fit of a light near the view.
    EXPECT_LT(degreesBetween(readings[0].shadingDirection, lights[0]), 1.2);
    // An offset that all share moves no direction: the shadows show it, also to the light that casts none.
    std::vector<DiffuseSphereReading> raised;
    for (const glm::vec3& l : lights) {
        Image picture = pictureUnder(l);
        for (float& value : picture.values) {
            value += 0.5f;
        }
        raised.push_back(readDiffuseSphere(picture, kCircle, l, "d.png"));
    }
    shareOffset(raised);
    EXPECT_NEAR(raised[0].offset, 0.5, 1e-4);
    EXPECT_LT(degreesBetween(raised[0].shadingDirection, readings[0].shadingDirection), 0.1);
}

TEST(DiffuseSphere, SaturatedPixelsAreLeftOut)
{
    const glm::vec3 l = glm::normalize(glm::vec3(-0.3f, 0.4f, 0.85f));
    Image picture = spherePicture(200, 180, kCircle,
                                  [&](const glm::vec3& n) { return glm::vec3(1.5f * std::max(0.0f, glm::dot(n, l))); });
    std::vector<uint8_t> saturated(picture.pixelCount(), 0);
    for (size_t i = 0; i < picture.values.size(); ++i) {
        saturated[i / 3] |= picture.values[i] >= 1;
        picture.values[i] = std::min(picture.values[i], 1.0f);
    }
    const DiffuseSphereReading reading = readDiffuseSphere(picture, kCircle, l, "d.png", {}, saturated);
    EXPECT_NEAR(reading.radiance.x / 1.5, 1, 0.005);
    EXPECT_LT(degreesBetween(reading.shadingDirection, l), 0.2);
}

TEST(DiffuseSphere, HighlightAndStainAreRejected)
{
    const glm::vec3 l = glm::normalize(glm::vec3(0.4f, 0.1f, 0.9f));
    const Image picture = spherePicture(200, 180, kCircle, [&](const glm::vec3& n) {
        const glm::vec3 mirrored = 2 * glm::dot(n, l) * n - l;
        const float gloss = mirrored.z > 0.97f ? 3.0f : 0.0f;
        const float stain = n.x < -0.2f && n.x > -0.4f && n.y > 0.2f && n.y < 0.5f ? 0.5f : 1.0f;
        return glm::vec3(0.5f * stain * std::max(0.0f, glm::dot(n, l)) + gloss);
    });
    const DiffuseSphereReading reading = readDiffuseSphere(picture, kCircle, l, "d.png");
    EXPECT_NEAR(reading.radiance.x, 0.5, 0.0025);
}

TEST(DiffuseSphere, ABlackPhotographIsNamed)
{
    const Image black(200, 180, 3);
    const std::string message = messageOf([&] { readDiffuseSphere(black, kCircle, {0, 0, 1}, "black.png"); });
    EXPECT_NE(message.find("black.png: has 0 pixels"), std::string::npos) << message;
}

TEST(Lights, ConditionOfKnownSets)
{
    const std::vector<Light> axes = {{{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
    EXPECT_NEAR(conditionOf(axes), 1, 1e-6);
    const std::vector<Light> plane = {{{1, 0, 0}}, {{0, 0, 1}}, {glm::normalize(glm::vec3(1, 0, 1))}};
    EXPECT_GT(conditionOf(plane), 1e6);
}

TEST(Lights, TooFewOrCoplanarAreRefusedWithTheNumber)
{
    Capture capture;
    capture.folder = "object";
    capture.lights = {
        {{1, 0, 0}}, {{0, 0, 1}}, {glm::normalize(glm::vec3(1, 0, 1))}, {glm::normalize(glm::vec3(2, 0, 1))}};
    EXPECT_NE(messageOf([&] { calibrateLights(capture); }).find("one plane with the object (condition number"),
              std::string::npos);
    capture.lights.resize(2);
    EXPECT_NE(messageOf([&] { calibrateLights(capture); }).find("has 2 usable light(s)"), std::string::npos);
    capture.lights.clear();
    EXPECT_NE(messageOf([&] { calibrateLights(capture); }).find("says nothing of its lights"), std::string::npos);
}

} // namespace
} // namespace nacre
