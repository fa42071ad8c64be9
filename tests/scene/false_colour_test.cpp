// Colours of views: what they say is told apart, on the scale that docs/formats.md names.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/scene/false_colour.h"

namespace nacre {
namespace {

float luminance(const glm::vec3& code)
{
    return glm::dot(code, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

TEST(FalseColour, NormalsFillTheCube)
{
    EXPECT_EQ(normalColour({0, 0, 1}), glm::vec3(0.5f, 0.5f, 1));
    EXPECT_EQ(normalColour({-1, 0, 0}), glm::vec3(0, 0.5f, 0.5f));
    EXPECT_EQ(normalColour({0, 1, 0}), glm::vec3(0.5f, 1, 0.5f));
}

// An eighth of the scale in one channel at least: two labels are never a matter of a code or two.
TEST(FalseColour, LabelsDiffer)
{
    for (int a = 0; a < 12; ++a) {
        for (int b = 0; b < a; ++b) {
            const glm::vec3 difference = glm::abs(labelColour(a) - labelColour(b));
            EXPECT_GT(std::max({difference.x, difference.y, difference.z}), 0.125f) << a << " and " << b;
        }
    }
    for (int label = 0; label < 255; ++label) {
        EXPECT_GT(luminance(labelColour(label)), 0.1f) << "black is no label";
    }
}

// The ends of matplotlib's table; brighter all the way, as viridis is made to be.
TEST(FalseColour, AnglesRunFromDarkBlueToYellow)
{
    EXPECT_LT(glm::length(angleColour(0) - glm::vec3(0.267f, 0.005f, 0.329f)), 0.014f);
    EXPECT_LT(glm::length(angleColour(kHalfPi / 2) - glm::vec3(0.128f, 0.567f, 0.551f)), 0.014f);
    EXPECT_LT(glm::length(angleColour(kHalfPi) - glm::vec3(0.993f, 0.906f, 0.144f)), 0.014f);
    for (int degree = 1; degree <= 90; ++degree) {
        EXPECT_GT(luminance(angleColour(degree * kHalfPi / 90)), luminance(angleColour((degree - 1) * kHalfPi / 90)));
    }
}

TEST(FalseColour, AQuarterOfThePixelsIsHatched)
{
    const glm::vec3 grey(0.5f);
    int striped = 0;
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
            striped += hatched(grey, {x, y}) != grey;
        }
    }
    EXPECT_EQ(striped, 64);
}

// A normal halfway between light and view has thetaH 0; thetaD is half the angle between them.
TEST(FalseColour, AnglesAreThoseOfTheBrightestLight)
{
    Scene scene;
    scene.surface.normals = NormalMap(3, 1);
    scene.surface.normals.confidence.assign(3, 1.0f);
    scene.surface.normals.normals = {
        glm::normalize(glm::vec3(std::sin(0.5f), 0, std::cos(0.5f))), {0, 0, 1}, glm::normalize(glm::vec3(-3, 0, 1))};
    scene.surface.labels.assign(3, 0);
    scene.surface.materials.emplace_back();
    scene.lights = {{{0, 0.6f, 0.8f}, glm::vec3(0.2f)}, {{std::sin(1.0f), 0, std::cos(1.0f)}, glm::vec3(1)}};
    const Image thetaH = referenceFalseColour(scene, Show::thetaH, {}),
                thetaD = referenceFalseColour(scene, Show::thetaD, {});
    const float code = 0.51f / 255; // rounding
    EXPECT_LT(glm::length(thetaH.rgb(0, 0) - angleColour(0)), 2 * code);
    EXPECT_LT(glm::length(thetaH.rgb(1, 0) - angleColour(0.5f)), 2 * code);
    EXPECT_LT(glm::length(thetaD.rgb(0, 0) - angleColour(0.5f)), 2 * code);
    EXPECT_EQ(thetaD.rgb(0, 0), thetaD.rgb(1, 0));
    EXPECT_EQ(thetaH.rgb(2, 0), glm::vec3(0)) << "the light does not reach it";
    scene.lights.clear();
    EXPECT_EQ(referenceFalseColour(scene, Show::thetaH, {}).values, Image(3, 1, 3).values);
}

} // namespace
} // namespace nacre
