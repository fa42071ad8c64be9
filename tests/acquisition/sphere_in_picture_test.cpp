// Calibration spheres that stand in the object's own photographs.
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/lights/lights.h"
#include "acquisition/lights/mirror_rays.h"
#include "acquisition/lights/sphere_in_picture.h"
#include "assets/synth/calibration_spheres.h"
#include "engine/files/hash_random.h"
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
            const double dx = x - kLeft - kSphere / 2.0 + reach * light.direction.x;
            const double dy = y - kTop - kSphere / 2.0 - reach * light.direction.y;
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
        std::transform(disc.begin(), disc.end(), picture.values.begin(),
                       [ball = ball, ground = ground](bool in) { return in ? ball : ground; });
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

const glm::dvec3 kSpheres[] = {{0.6, 0.1, 0.05}, {-0.55, 0.2, 0.1}, {0.1, -0.7, 0}};

// Rays from the first spheres to places around the object.
std::vector<std::vector<MirrorRay>> raysTo(const std::vector<glm::dvec3>& places, size_t spheres, double noise = 0)
{
    std::vector<std::vector<MirrorRay>> rays;
    uint64_t random = 3;
    const auto draw = [&] { return noise * (static_cast<double>(nextRandom(random) % 2001) / 1000 - 1); };
    for (const glm::dvec3& place : places) {
        std::vector<MirrorRay>& ofLight = rays.emplace_back();
        for (size_t k = 0; k < spheres; ++k) {
            const glm::dvec3 direction = glm::normalize(place - kSpheres[k]);
            ofLight.push_back({kSpheres[k], glm::normalize(direction + glm::dvec3(draw(), draw(), draw()))});
        }
    }
    return rays;
}

std::vector<glm::dvec3> placesAt(double distance)
{
    std::vector<glm::dvec3> places;
    for (const Light& light : lightsAround()) {
        places.push_back(distance * glm::dvec3(light.direction));
    }
    return places;
}

TEST(MirrorRays, CrossWhereTheLightsStand)
{
    std::vector<glm::dvec3> places = placesAt(2.5);
    places[1] *= 1.4;
    for (const size_t spheres : {size_t{2}, size_t{3}}) {
        const MirrorLights found = lightsOfRays(raysTo(places, spheres), {});
        EXPECT_NEAR(found.apart, 0, 1e-4);
        EXPECT_NE(found.placed.find("2.5 to 3.5 widths"), std::string::npos) << found.placed;
        for (size_t i = 0; i < places.size(); ++i) {
            const glm::dvec3 place =
                static_cast<double>(found.lights[i].distance) * glm::dvec3(found.lights[i].direction);
            EXPECT_NEAR(glm::distance(place, places[i]), 0, 1e-5) << i;
        }
    }
}

// Half a degree of error each.
TEST(MirrorRays, OfDistantLightsAreParallelButForChance)
{
    const MirrorLights found = lightsOfRays(raysTo(placesAt(1e6), 3, 0.009), {});
    EXPECT_TRUE(found.placed.empty());
    for (size_t i = 0; i < kLights; ++i) {
        EXPECT_TRUE(std::isinf(found.lights[i].distance));
        EXPECT_LT(degreesBetween(found.lights[i].direction, lightsAround()[i].direction), 0.6);
    }
    EXPECT_GT(found.apart, 0.1);
}

TEST(MirrorRays, OneSphereAndADistanceAreEnough)
{
    const std::vector<glm::dvec3> places = placesAt(3);
    const MirrorLights told = lightsOfRays(raysTo(places, 1), 3.0), untold = lightsOfRays(raysTo(places, 1), {});
    for (size_t i = 0; i < places.size(); ++i) {
        EXPECT_FLOAT_EQ(told.lights[i].distance, 3);
        EXPECT_LT(degreesBetween(told.lights[i].direction, glm::vec3(glm::normalize(places[i]))), 0.01);
        EXPECT_TRUE(std::isinf(untold.lights[i].distance));
    }
    EXPECT_GT(degreesBetween(untold.lights[0].direction, lightsAround()[0].direction), 5) << "from where the sphere is";
}

// Two spheres on a dark table, far apart, under lamps at 2 widths of the picture, which is all object here.
TEST(TwoSpheresInAPicture, PlaceTheLights)
{
    const TempFolder folder;
    constexpr int kWide = 620, kHigh = 230;
    const glm::ivec2 corners[] = {{10, 20}, {415, 25}};
    const std::vector<glm::dvec3> places = placesAt(2);
    std::string list = fmt::format("{}\n", kLights);
    for (int i = 0; i < kLights; ++i) {
        Image picture(kWide, kHigh, 3, 0.02f);
        for (const glm::ivec2& corner : corners) {
            const glm::dvec3 centre =
                glm::dvec3(corner.x + kSphere / 2 - kWide / 2, kHigh / 2 - corner.y - kSphere / 2, 0) / double{kWide};
            glm::dvec3 direction = glm::normalize(places[i] - centre);
            for (int step = 0; step < 20; ++step) { // from the point whose normal lies between it and the view
                const glm::dvec3 normal = glm::normalize(direction + glm::dvec3(0, 0, 1));
                direction = glm::normalize(places[i] - centre - 0.47 * kSphere / kWide * normal);
            }
            paste(mirrorSphereRadiance(kSphere, {glm::vec3(direction), glm::vec3(1)}, 0.01), corner.x, corner.y,
                  calibrationSphereMask(kSphere), picture);
        }
        writePicture(folder / fmt::format("photo {}.png", i + 1), picture);
        list += fmt::format("/lab/photo {}.png\n", i + 1);
    }
    writeText(folder / "list.lp", list);
    CaptureOptions options;
    options.mirrorSphere = "in-picture:5,15,202,205";
    options.moreMirrorSpheres = {"in-picture:410,20,202,205"};
    const Rig rig = calibrateLights(loadCapture(folder.path(), options));
    EXPECT_NE(rig.directionsFrom.find("rays cross"), std::string::npos) << rig.directionsFrom;
    for (size_t i = 0; i < places.size(); ++i) {
        // Directions are good to a third of a degree (above), spheres 0.65 widths apart: 3 % of a distance of 2.
        EXPECT_NEAR(rig.lights[i].distance, 2, 0.1) << i;
        EXPECT_LT(degreesBetween(rig.lights[i].direction, glm::vec3(glm::normalize(places[i]))), 0.5) << i;
    }
    options.lightDistance = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(std::isinf(calibrateLights(loadCapture(folder.path(), options)).lights[0].distance));
    options.moreMirrorSpheres = {folder.path()};
    expectError([&] { loadCapture(folder.path(), options); }, {"several mirror spheres", "in-picture:X,Y,W,H for each"},
                Error::kUsage);
}

} // namespace
} // namespace nacre
