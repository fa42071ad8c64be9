// Regions marked by hand: normals smoothed in from their neighbours.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/capture/capture.h"
#include "acquisition/normals/smooth_fill.h"
#include "engine/files/measures.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/support/write_capture.h"

namespace nacre {
namespace {

constexpr int kFillSize = 128;

// 1 within `radius` (in radii of the sphere) of the middle.
std::vector<uint8_t> discOf(double radius)
{
    std::vector<uint8_t> disc;
    for (int i = 0; i < kFillSize * kFillSize; ++i) {
        const double x = (i % kFillSize + 0.5) / kFillSize * 2 - 1, y = (i / kFillSize + 0.5) / kFillSize * 2 - 1;
        disc.push_back(std::hypot(x, y) < radius);
    }
    return disc;
}

TEST(SmoothFill, AHoleInASphereComesBack)
{
    const NormalMap sphere = sphereNormalMap(kFillSize);
    NormalMap filled = sphere;
    const double radius = 0.3;
    const std::vector<uint8_t> hole = discOf(radius), object = discOf(1);
    for (size_t i = 0; i < hole.size(); ++i) {
        if (hole[i]) {
            filled.normals[i] = glm::vec3(1, 0, 0); // what the fill may not look at
        }
    }
    const size_t marked = std::count(hole.begin(), hole.end(), 1);
    EXPECT_EQ(fillSmoothly(filled, hole, object), marked);
    // x and y of a sphere's normal are harmonic; z becomes sqrt(1 - radius^2) all over, so that the angle at r is
    // atan(r / sqrt(1 - radius^2)) in place of asin(r): at most 0.33 degrees; 0.1 for the border's steps.
    double largest = 0;
    for (size_t i = 0; i < hole.size(); ++i) {
        if (hole[i]) {
            largest = std::max(largest, degreesBetween(filled.normals[i], sphere.normals[i]));
            EXPECT_FLOAT_EQ(filled.confidence[i], kSmoothedConfidence);
            EXPECT_NEAR(glm::length(filled.normals[i]), 1, 1e-5);
        } else {
            EXPECT_EQ(filled.normals[i], sphere.normals[i]);
        }
    }
    EXPECT_LT(largest, 0.43);
}

TEST(SmoothFill, WhatTouchesNoNormalStaysWithout)
{
    NormalMap map(kFillSize, kFillSize);
    const std::vector<uint8_t> all(kFillSize * kFillSize, 1);
    EXPECT_EQ(fillSmoothly(map, all, all), 0u);
    EXPECT_EQ(map.confidence[kFillSize], 0.0f);
}

TEST(SmoothFill, MasksThatCannotBeMeantAreRefused)
{
    const TempFolder folder;
    writeDiligentFolder(folder / "c", 4);
    const auto refused = [&](const std::vector<std::string>& fragments) {
        CaptureOptions options;
        options.smooth = folder / "smooth.png";
        expectError([&] { loadCapture(folder / "c", options); }, fragments);
    };
    writeMask(folder / "smooth.png", 0);
    refused({"smooth.png", "all of the object"});
    writeMask(folder / "smooth.png", 2, kTestWidth + 1, kTestHeight);
    refused({"smooth.png", "as the photographs"});
    writeMask(folder / "smooth.png", 5);
    CaptureOptions options;
    options.smooth = folder / "smooth.png";
    EXPECT_EQ(loadCapture(folder / "c", options).smooth[5], 1);
}

} // namespace
} // namespace nacre
