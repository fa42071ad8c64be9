// Colours of views: what they say is told apart, on the scale that docs/formats.md names.
#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
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

// As eyes without red or green cones see a colour (Machado, Oliveira, Fernandes, A Physiologically-based Model for
// Simulation of Color Vision Deficiency, 2009). The colours that labels had before were 0.05 apart there.
TEST(FalseColour, TheColourBlindTellEightLabelsApart)
{
    const glm::mat3 protanopia(0.152286f, 0.114503f, -0.003882f, 1.052583f, 0.786281f, -0.048116f, -0.204868f,
                               0.099216f, 1.051998f);
    const glm::mat3 deuteranopia(0.367322f, 0.280085f, -0.011820f, 0.860646f, 0.672501f, 0.042940f, -0.227968f,
                                 0.047413f, 0.968881f);
    for (const glm::mat3& eye : {protanopia, deuteranopia}) {
        const auto seen = [&](int label) {
            const glm::vec3 linear = glm::pow(labelColour(label), glm::vec3(2.2f));
            return glm::pow(glm::clamp(eye * linear, 0.0f, 1.0f), glm::vec3(1 / 2.2f));
        };
        for (int a = 0; a < 8; ++a) {
            for (int b = 0; b < a; ++b) {
                const glm::vec3 difference = glm::abs(seen(a) - seen(b));
                EXPECT_GT(std::max({difference.x, difference.y, difference.z}), 0.125f) << a << " and " << b;
            }
        }
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
