// What capture.json takes away from photographs: ambient light, an offset, photographs, pixels.
#include <gtest/gtest.h>

#include "acquisition/capture/capture.h"
#include "acquisition/capture/capture_maps.h"
#include "acquisition/capture/observations.h"
#include "acquisition/lights/lights.h"
#include "engine/lights/light_files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/support/write_capture.h"

namespace nacre {
namespace {

// Two roundings to a 16-bit code, and those of the floats.
constexpr float kTwoCodes16 = 1.01f / 65535;

class CaptureCorrections : public testing::Test {
protected:
    CaptureCorrections()
    {
        for (int i = 1; i <= 4; ++i) {
            writePicture(folder_ / ("p" + std::to_string(i) + ".png"), i);
            writePicture(folder_ / "sphere" / (std::to_string(i) + ".png"), testPicture(i, 5, 5));
        }
        writeText(folder_ / "lights.txt", directionLines(4));
    }
    Capture load(const std::string& photographs, const std::string& rest = "", const CaptureOptions& options = {})
    {
        writeText(folder_ / "capture.json", R"({"format": "nacre capture", "version": 1, "photographs": )" +
                                                photographs + (rest.empty() ? "" : ", " + rest) + "}");
        return loadCapture(folder_.path(), options);
    }
    void expectRefused(const std::string& rest, std::vector<std::string> fragments)
    {
        fragments.emplace_back("capture.json");
        expectError([&] { load(files_, rest); }, fragments);
    }
    static Observations read(const Capture& capture)
    {
        ObservationReader reader(capture, 1);
        Observations block;
        EXPECT_TRUE(reader.next(block));
        return block;
    }
    TempFolder folder_;
    const std::string files_ = R"(["p1.png", "p2.png", "p3.png", "p4.png"])";
};

TEST_F(CaptureCorrections, OffsetAndAmbientAreTakenAwayOnTheCommonScale)
{
    const auto timed = [](int i) { return R"({"file": "p)" + std::to_string(i) + R"(.png", "exposureSeconds": 2})"; };
    const Capture capture = load("[" + timed(1) + "," + timed(2) + "," + timed(3) + "]",
                                 R"("offset": 0.05, "ambient": {"file": "p4.png", "exposureSeconds": 0.5})");
    const Observations block = read(capture);
    ASSERT_EQ(block.lightCount, 3u);
    bool below = false;
    for (int light = 0; light < 3; ++light) {
        for (size_t p = 0; p < block.pixels.size(); ++p) {
            const int x = static_cast<int>(p) % kTestWidth, y = static_cast<int>(p) / kTestWidth;
            const glm::vec3 expected =
                (testPicture(light + 1).rgb(x, y) - 0.05f) / 2.0f - (testPicture(4).rgb(x, y) - 0.05f) / 0.5f;
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(block.radianceOf(p)[light][c], expected[c], 2 * kTwoCodes16);
                below |= expected[c] < 0;
            }
        }
    }
    EXPECT_TRUE(below) << "values below 0 are kept, so some have to be tried";
}

TEST_F(CaptureCorrections, WhereTheAmbientPhotographIsClippedNothingIsTrusted)
{
    Image ambient = testPicture(4);
    ambient.at(3, 2, 1) = 1;
    writePicture(folder_ / "p4.png", ambient);
    const Observations block = read(load(R"(["p1.png", "p2.png", "p3.png"])", R"("ambient": "p4.png")"));
    for (size_t p = 0; p < block.pixels.size(); ++p) {
        const bool clipped = block.pixels[p] == 2 * kTestWidth + 3;
        for (const uint8_t saturated : block.saturatedOf(p)) {
            EXPECT_EQ(saturated != 0, clipped);
        }
    }
}

TEST_F(CaptureCorrections, AnOffsetIsEstimatedWhereShadowsShowIt)
{
    // Each pixel is in shadow under one of the lights, and lit by a ramp under the others.
    const auto write = [&](float offset, bool shadows) {
        for (int i = 0; i < 4; ++i) {
            Image picture(40, 40, 3);
            for (size_t p = 0; p < picture.pixelCount(); ++p) {
                const bool dark = shadows && static_cast<int>(p / 7 % 4) == i;
                const float value = offset + (dark ? 0 : 0.05f + 0.8f * static_cast<float>(p) / 1600);
                picture.setRgb(static_cast<int>(p % 40), static_cast<int>(p / 40), glm::vec3(value));
            }
            writePicture(folder_ / ("p" + std::to_string(i + 1) + ".png"), picture);
        }
    };
    write(0.07f, true);
    EXPECT_NEAR(load(files_, R"("offset": "auto")").offset, 0.07f, kTwoCodes16);
    write(0.0f, true);
    EXPECT_EQ(load(files_, R"("offset": "auto")").offset, 0.0f);
    write(0.07f, false); // what is least here is shading
    const Capture capture = load(files_, R"("offset": "auto")");
    EXPECT_EQ(capture.offset, 0.0f);
    EXPECT_NE(capture.offsetSource.find("do not agree"), std::string::npos) << capture.offsetSource;
    CaptureOptions none;
    none.offset = OffsetChoice{false, 0.01f};
    EXPECT_EQ(load(files_, R"("offset": 0.07)", none).offset, 0.01f);
}

TEST_F(CaptureCorrections, SkippedPhotographsGoWithTheirLightsAndSpheres)
{
    const std::string rest = R"("lights": "lights.txt", "mirrorSphere": {"photographs": ["sphere/1.png", "sphere/2.png",
        "sphere/3.png", "sphere/4.png"], "circle": [2.5, 2.5, 2]})";
    const std::vector<Light> all = load(files_, rest).lights;
    const auto expectSecondGone = [&](const Capture& capture) {
        EXPECT_EQ(capture.skipped, std::vector<std::string>{"p2.png"});
        ASSERT_EQ(capture.photographs.size(), 3u);
        EXPECT_EQ(capture.photographs[1].name, "p3.png");
        ASSERT_EQ(capture.lights.size(), 3u);
        EXPECT_EQ(capture.lights[1].direction, all[2].direction);
        ASSERT_EQ(capture.mirrorSphere->photographs.size(), 3u);
        EXPECT_EQ(capture.mirrorSphere->photographs[1].name, "3.png");
    };
    expectSecondGone(
        load(R"(["p1.png", {"file": "p2.png", "skip": true}, {"file": "p3.png", "skip": false}, "p4.png"])", rest));
    CaptureOptions options;
    options.skip = {"P2"};
    expectSecondGone(load(files_, rest, options));
    options.skip = {"p7.png"};
    expectError([&] { load(files_, rest, options); }, {"p7.png names 0 photographs", "p1.png"}, Error::kUsage);
    options.skip = {"p1", "p2"};
    expectError([&] { load(files_, rest, options); }, {"has 2 photographs"});
}

TEST_F(CaptureCorrections, ARigMayHaveTheLightsOfAllOrOfTheRest)
{
    CaptureOptions options;
    options.skip = {"p1.png"};
    options.rig = folder_ / "lights.txt";
    const Capture all = load(files_, "", options);
    writeText(folder_ / "rest.lp", "3\np2.png 0 0 1\np3.png 0 1 1\np4.png 1 0 1\n");
    options.rig = folder_ / "rest.lp";
    const Capture rest = load(files_, "", options);
    EXPECT_EQ(rest.lights[0].direction, glm::vec3(0, 0, 1));
    EXPECT_NE(rest.lightsOrder.find("by name"), std::string::npos);
    EXPECT_NE(all.lightsOrder.find("by order"), std::string::npos);
    EXPECT_EQ(all.lights[0].direction, loadDirectionTable(folder_ / "lights.txt").lights[1].direction);
}

TEST_F(CaptureCorrections, CropAndScaleTakeBoxesOfPixels)
{
    Image mask(kTestWidth, kTestHeight, 1, 1.0f);
    mask.at(3, 3) = 0; // in the second box of the second row
    writePicture(folder_ / "mask.png", mask);
    const Capture capture = load(files_, R"("crop": [1, 1, 7, 5], "scale": 0.5, "mask": "mask.png")");
    EXPECT_EQ(capture.width, 3);
    EXPECT_EQ(capture.height, 2);
    EXPECT_EQ(capture.mask, (std::vector<uint8_t>{1, 1, 1, 1, 0, 1}));
    const Observations block = read(capture);
    ASSERT_EQ(block.pixels.size(), 5u);
    for (size_t p = 0; p < block.pixels.size(); ++p) {
        const int x = 1 + 2 * static_cast<int>(block.pixels[p] % 3), y = 1 + 2 * static_cast<int>(block.pixels[p] / 3);
        for (int light = 0; light < 4; ++light) {
            const Image picture = testPicture(light + 1);
            const glm::vec3 mean =
                (picture.rgb(x, y) + picture.rgb(x + 1, y) + picture.rgb(x, y + 1) + picture.rgb(x + 1, y + 1)) / 4.0f;
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(block.radianceOf(p)[light][c], mean[c], kTwoCodes16);
            }
        }
    }
}

TEST_F(CaptureCorrections, ABoxWithAClippedPixelIsClipped)
{
    Image picture = testPicture(2);
    picture.at(5, 3, 0) = 1;
    writePicture(folder_ / "p2.png", picture);
    const Observations block = read(load(files_, R"("scale": 0.5)"));
    for (size_t p = 0; p < block.pixels.size(); ++p) {
        for (size_t light = 0; light < 4; ++light) {
            EXPECT_EQ(block.saturatedOf(p)[light] != 0, light == 1 && block.pixels[p] == 1 * 4 + 2);
        }
    }
}

TEST_F(CaptureCorrections, CropIsTheSameForAnyBudget)
{
    const Capture capture = load(files_, R"("crop": [2, 1, 5, 4])");
    const Observations whole = read(capture);
    ObservationReader rows(capture, 1, 1);
    size_t seen = 0;
    for (Observations block; rows.next(block);) {
        for (size_t p = 0; p < block.pixels.size(); ++p, ++seen) {
            EXPECT_EQ(block.pixels[p], whole.pixels[seen]);
            EXPECT_EQ(block.radianceOf(p)[3], whole.radianceOf(seen)[3]);
        }
    }
    EXPECT_EQ(seen, whole.pixels.size());
}

TEST_F(CaptureCorrections, TrueNormalsFollowTheWindow)
{
    const Capture capture = load(files_, R"("crop": [1, 2, 4, 2], "scale": 0.5)");
    NormalMap truth(kTestWidth, kTestHeight);
    std::fill(truth.normals.begin(), truth.normals.end(), glm::vec3(0, 0, 1));
    std::fill(truth.confidence.begin(), truth.confidence.end(), 1.0f);
    for (const int x : {1, 2}) {
        truth.normals[truth.index(x, 2)] = {1, 0, 0};
    }
    truth.confidence[truth.index(3, 3)] = 0;
    const NormalMap seen = windowedNormals(truth, capture, "t.exr");
    ASSERT_EQ(seen.normals.size(), 2u);
    EXPECT_NEAR(seen.normals[0].x, std::sqrt(0.5f), 1e-6f);
    EXPECT_EQ(seen.confidence[1], 0.0f);
    expectError([&] { windowedNormals(NormalMap(2, 1), capture, "t.exr"); }, {"t.exr: is 2x1", "8x6"});
}

TEST_F(CaptureCorrections, LabelsHaveThePhotographsSize)
{
    writePicture(folder_ / "labels.png", testPicture(1, kTestWidth, kTestHeight, 1));
    EXPECT_EQ(load(files_, R"("labels": "labels.png", "crop": [0, 0, 2, 2])").labelsFile, folder_ / "labels.png");
    writePicture(folder_ / "labels.png", testPicture(1, 3, 3, 1));
    expectError([&] { load(files_, R"("labels": "labels.png")"); }, {"labels.png", "3 x 3", "8 x 6"});
}

TEST_F(CaptureCorrections, DistancesCountInWidthsOfTheObject)
{
    const Capture capture = load(files_, R"("lights": "lights.txt", "lightDistance": 2, "objectWidth": 0.2)");
    EXPECT_EQ(capture.lightDistance, 10);
    EXPECT_TRUE(capture.lightPlaces.empty());
    EXPECT_EQ(load(files_, R"("lights": "lights.txt", "fieldOfView": 20)").fieldOfView, 20);
}

TEST_F(CaptureCorrections, WhatIsWrongIsNamed)
{
    expectRefused(R"("offset": "dark")", {"offset is \"dark\"", "\"auto\""});
    expectRefused(R"("offset": -0.1)", {"offset is -0.1"});
    expectRefused(R"("ambient": {"file": "p4.png", "exposureSeconds": 1})", {"ambient has an exposure time"});
    expectRefused(R"("ambient": {"file": "p4.png", "light": 1})", {"ambient", "\"light\""});
    expectRefused(R"("crop": [0, 0, 4])", {"crop has 3 numbers"});
    expectRefused(R"("crop": [0, 0.5, 4, 4])", {"crop is [0, 0.5, 4, 4]"});
    expectRefused(R"("crop": [0, 0, 0, 4])", {"crop is"});
    expectRefused(R"("crop": [5, 0, 4, 4])", {"4 x 4 from (5, 0)", "8 x 6"});
    expectRefused(R"("scale": 0.7)", {"scale is 0.7", "1/2"});
    expectRefused(R"("scale": 2)", {"scale is 2"});
    expectRefused(R"("crop": [0, 0, 2, 2], "scale": 0.25)", {"2 x 2", "1/4 to nothing"});
    expectRefused(R"("lightDistance": 2)", {"\"lightDistance\" alone"});
    expectRefused(R"("lightDistance": 0, "objectWidth": 1)", {"lightDistance is 0"});
    expectRefused(R"("fieldOfView": 150)", {"fieldOfView is 150", "120"});
    expectError([&] { load(R"(["p1.png", {"file": "p2.png", "skip": 1}, "p3.png"])"); },
                {"photographs[1].skip is a number", "true or false"});
}

} // namespace
} // namespace nacre
