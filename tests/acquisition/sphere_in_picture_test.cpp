// Calibration spheres that stand in the object's own photographs.
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/lights/lights.h"
#include "acquisition/lights/sphere_in_picture.h"
#include "assets/synth/calibration_spheres.h"
#include "engine/files/measures.h"
#include "tests/support/expect_error.h"
#include "tests/support/sphere_picture.h"
#include "tests/support/temp_folder.h"
#include "tests/support/write_capture.h"

namespace nacre {
namespace {
namespace fs = std::filesystem;

constexpr int kLights = 6;
constexpr int kSphere = 192; // side of the sphere's picture: its highlights are three pixels wide
// Where it is pasted, right of and below the object.
constexpr int kLeft = 80, kTop = 30, kWidth = 300, kHeight = 250;

std::vector<Light> lightsAround()
{
    std::vector<Light> lights;
    for (int i = 0; i < kLights; ++i) {
        const double theta = (12 + 7 * i) * M_PI / 180, phi = 2.4 * i;
        lights.push_back(
            {{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)}, glm::vec3(1)});
    }
    return lights;
}

void paste(const Image& from, int left, int top, const std::vector<uint8_t>& mask, Image& to)
{
    for (int y = 0; y < from.height; ++y) {
        for (int x = 0; x < from.width; ++x) {
            if (mask[static_cast<size_t>(y) * from.width + x]) {
                to.setRgb(left + x, top + y, glm::min(from.rgb(x, y), glm::vec3(1)));
            }
        }
    }
}

// A grey table with a cast shadow that turns with the light, a matt ball as the object, and a mirror sphere beside it.
Image photographUnder(const Light& light, const Image& mirror, float table)
{
    Image picture(kWidth, kHeight, 3);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const double reach = 0.47 * kSphere / light.direction.z; // where the sphere's shadow has its middle
            const double dx = x - kLeft - kSphere / 2 + reach * light.direction.x;
            const double dy = y - kTop - kSphere / 2 - reach * light.direction.y;
            const bool shadow = std::hypot(dx, dy) < 0.47 * kSphere;
            picture.setRgb(x, y, glm::vec3((shadow ? 0.2f : 1.0f) * table * light.direction.z));
        }
    }
    paste(diffuseSphereRadiance(60, glm::vec3(0.9f), light), 8, 20, calibrationSphereMask(60), picture);
    paste(mirror, kLeft, kTop, calibrationSphereMask(kSphere), picture);
    return picture;
}

class SphereInPictureTest : public testing::Test {
protected:
    static void SetUpTestSuite()
    {
        for (const Light& light : lightsAround()) {
            mirrors_.push_back(mirrorSphereRadiance(kSphere, light, 0.01));
        }
    }
    static void TearDownTestSuite() { mirrors_.clear(); }
    void write(float table, bool directions)
    {
        std::string list = fmt::format("{}\n", kLights);
        for (int i = 0; i < kLights; ++i) {
            writePicture(folder_ / fmt::format("photo {}.png", i + 1), photographUnder(truth_[i], mirrors_[i], table));
            list += fmt::format("/lab/photo {}.png{}\n", i + 1, directions ? " 0 0 1" : "");
        }
        writeText(folder_ / "list.lp", list);
    }
    Rig rigOf(const std::string& sphere)
    {
        CaptureOptions options;
        options.mirrorSphere = sphere;
        return calibrateLights(loadCapture(folder_.path(), options));
    }
    void expectLights(const Rig& rig)
    {
        ASSERT_EQ(rig.lights.size(), truth_.size());
        for (size_t i = 0; i < truth_.size(); ++i) {
            // A pixel of the highlight is 2 / 90 rad = 1.3 degrees of the light; outline and centroid tell a third of
            // one.
            EXPECT_LT(degreesBetween(rig.lights[i].direction, truth_[i].direction), 0.5) << i;
        }
    }
    void expectRefused(const std::string& sphere, const std::vector<std::string>& fragments,
                       int exitCode = Error::kData)
    {
        expectError([&] { rigOf(sphere); }, fragments, exitCode);
    }

    static std::vector<Image> mirrors_; // one a light
    TempFolder folder_;
    std::vector<Light> truth_ = lightsAround();
};

std::vector<Image> SphereInPictureTest::mirrors_;

TEST_F(SphereInPictureTest, OutlineAndLightsAreFoundInAListOfNames)
{
    write(0.3f, false);
    const Rig rig = rigOf("in-picture:70,18,220,215");
    expectLights(rig);
    EXPECT_NE(rig.directionsFrom.find("70,18,220,215"), std::string::npos) << rig.directionsFrom;
}

TEST_F(SphereInPictureTest, OnABlackGroundAsWell)
{
    write(0.0f, false);
    expectLights(rigOf("in-picture:70,18,220,215"));
}

TEST_F(SphereInPictureTest, CountsForMoreThanTheListsOwnDirections)
{
    write(0.3f, true);
    expectLights(rigOf("in-picture:70,18,220,215"));
}

TEST_F(SphereInPictureTest, MasksOfBothSizesGiveTheOutline)
{
    write(0.011f, false); // no contrast to the sphere's room
    Image whole(kWidth, kHeight, 1), crop(220, 215, 1);
    const std::vector<uint8_t> disc = calibrationSphereMask(kSphere);
    for (int y = 0; y < kSphere; ++y) {
        for (int x = 0; x < kSphere; ++x) {
            const float inside = disc[static_cast<size_t>(y) * kSphere + x];
            whole.at(kLeft + x, kTop + y) = inside;
            crop.at(kLeft + x - 70, kTop + y - 18) = inside;
        }
    }
    // Beside the photographs it is not taken for the object's.
    writePicture(folder_ / "sphere-mask.png", whole);
    expectLights(rigOf("in-picture:70,18,220,215," + (folder_ / "sphere-mask.png").string()));
    fs::remove(folder_ / "sphere-mask.png");
    writePicture(folder_ / "elsewhere" / "crop.png", crop);
    expectLights(rigOf("in-picture:70,18,220,215," + (folder_ / "elsewhere/crop.png").string()));
    writePicture(folder_ / "elsewhere" / "other.png", Image(30, 20, 1, 1.0f));
    expectRefused("in-picture:70,18,220,215," + (folder_ / "elsewhere/other.png").string(),
                  {"other.png", "30 x 20", "300 x 250", "220 x 215"});
}

TEST_F(SphereInPictureTest, SkippedPhotographsAreSkippedInBoth)
{
    write(0.3f, false);
    CaptureOptions options;
    options.mirrorSphere = "in-picture:70,18,220,215";
    options.skip = {"photo 3"};
    const Rig rig = calibrateLights(loadCapture(folder_.path(), options));
    truth_.erase(truth_.begin() + 2);
    expectLights(rig);
}

TEST_F(SphereInPictureTest, BadCropsNameFileAndNumbers)
{
    write(0.3f, false);
    expectRefused("in-picture:150,18,220,215", {"photo 1.png", "300 x 250", "150,18,220,215", "not inside"});
    expectRefused("in-picture:2147483647,0,10,10", {"not inside"});
    expectRefused("in-picture:0,100,60,100", {"photo 1.png", "no outline", "0,100,60,100"});
    // The matt ball has an outline, but no highlight.
    expectRefused("in-picture:2,14,72,72", {"photo", ".png", "no highlight"});
    for (const std::string text : {"in-picture:", "in-picture:1,2,3", "in-picture:1,2,3,0", "in-picture:-1,2,3,4",
                                   "in-picture:1,2,3,4,", "in-picture:1,2,3,4.5", "in-picture:1;2;3;4"}) {
        expectRefused(text, {"mirror sphere", text, "X,Y,W,H"}, Error::kUsage);
    }
}

TEST_F(SphereInPictureTest, ListsOfNamesAloneWantASphere)
{
    write(0.3f, false);
    expectError([&] { calibrateLights(loadCapture(folder_.path())); }, {"says nothing of its lights"});
    writeText(folder_ / "list.lp", "photo 1.png\nphoto 2.png\nphoto 3.png 0 0 1\n");
    expectError([&] { loadCapture(folder_.path()); }, {"list.lp", "photo 1.png"});
    writeText(folder_ / "list.lp", "4\nphoto 1.png\nphoto 2.png\nphoto 3.png\n");
    expectError([&] { loadCapture(folder_.path()); }, {"list.lp", "announces 4"});
}

TEST(CircleSearch, FindsDiscsDarkerAndBrighterThanTheirGround)
{
    const Circle truth{61.3, 48.8, 30.2};
    for (const auto& [ball, ground] : {std::pair(0.1f, 0.6f), std::pair(0.7f, 0.2f), std::pair(0.01f, 0.0f)}) {
        const std::vector<uint8_t> disc = discMask(120, 100, truth);
        Image picture(120, 100, 1);
        std::transform(disc.begin(), disc.end(), picture.values.begin(), [&](bool in) { return in ? ball : ground; });
        picture.at(60, 50) = 0.9f; // a highlight
        const std::optional<Circle> found = findCircle(picture);
        ASSERT_TRUE(found);
        // As for masks: half a pixel of grain over some 200 pixels of border.
        EXPECT_NEAR(found->x, truth.x, 0.1);
        EXPECT_NEAR(found->y, truth.y, 0.1);
        EXPECT_NEAR(found->radius, truth.radius, 0.1);
    }
    EXPECT_FALSE(findCircle(Image(50, 50, 1, 0.4f)));
}

// Half of the outline could be many things'.
TEST(CircleSearch, WantsMostOfTheOutline)
{
    const std::vector<uint8_t> disc = discMask(120, 100, {61.3, 48.8, 30.2});
    Image picture(120, 100, 1, 0.6f);
    for (size_t i = 0; i < disc.size(); ++i) {
        picture.values[i] = disc[i] && i % 120 < 61 ? 0.1f : 0.6f;
    }
    EXPECT_FALSE(findCircle(picture));
}

} // namespace
} // namespace nacre
