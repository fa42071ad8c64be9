// Lights near the object: places of pixels, pictures of a plane against the formula, files.
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/scene/pixel_lights.h"
#include "engine/scene/reference.h"
#include "engine/surface/object_places.h"
#include "shared/brdf_coords.h"
#include "shared/lens.h"
#include "tests/support/expect_error.h"
#include "tests/support/ray_cast.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

// A white Lambertian plane of 20 x 10 pixels in a larger picture, its middle at (15, 9).
Surface whitePlane()
{
    NormalMap normals(40, 20);
    for (int y = 4; y < 14; ++y) {
        for (int x = 5; x < 25; ++x) {
            normals.normals[normals.index(x, y)] = {0, 0, 1};
            normals.confidence[normals.index(x, y)] = 1;
        }
    }
    BrdfTable table({2, 2, 2}, {kHalfDifference, kHalfPi});
    table.values.assign(table.values.size(), glm::vec3(1 / kPi));
    table.confidence.assign(table.confidence.size(), 1);
    return transferredSurface(normals, Material{"white", table, {}, {}});
}

glm::vec3 placeOf(const Surface& surface, int x, int y)
{
    return pixelPlaces(surface)[surface.normals.index(x, y)];
}

TEST(PixelPlaces, CountWidthsFromTheMiddleOfTheObject)
{
    Surface surface = whitePlane();
    EXPECT_NEAR(glm::distance(placeOf(surface, 24, 4), glm::vec3(9.5f, 4.5f, 0) / 20.0f), 0, 1e-6);
    surface.height = Image(40, 20, 1);
    for (size_t i = 0; i < surface.labels.size(); ++i) { // of any constant
        surface.height.values[i] = surface.normals.confidence[i] > 0 ? 7.0f : 0.0f;
    }
    surface.height.values[surface.normals.index(14, 8)] = 11;
    EXPECT_NEAR(glm::distance(placeOf(surface, 14, 8), glm::vec3(-0.5f, 0.5f, 4) / 20.0f), 0, 1e-6);
    EXPECT_NEAR(placeOf(surface, 24, 4).z, 0, 1e-6);
}

TEST(NearLight, OfAPlaneIsTheCosineOverTheSquareOfTheDistance)
{
    const Surface surface = whitePlane();
    const glm::vec3 direction = glm::normalize(glm::vec3(0.5f, -0.3f, 0.8f)), irradiance(2, 3, 4);
    const float distance = 0.9f;
    const Frame frame = renderReference({surface, {{direction, irradiance, distance}}, {0, 0, 1}});
    for (int y = 4; y < 14; ++y) {
        for (int x = 5; x < 25; ++x) {
            const glm::vec3 towards = distance * direction - glm::vec3(x + 0.5f - 15, 9 - y - 0.5f, 0) / 20.0f;
            const float r = glm::length(towards);
            const glm::vec3 expected = irradiance / kPi * (towards.z / r) * (distance * distance / (r * r));
            EXPECT_NEAR(glm::distance(frame.rgb(x, y), expected), 0, 1e-5f * glm::length(expected));
        }
    }
}

// Half of a plane that stands 0.2 widths higher, seen through a lens of 37 degrees whose axis is not the middle.
Surface stepBeforeLens()
{
    Surface surface = transferredSurface(NormalMap(64, 64), Material{"white", whitePlane().materials[0].table, {}, {}});
    std::fill(surface.normals.normals.begin(), surface.normals.normals.end(), glm::vec3(0, 0, 1));
    std::fill(surface.normals.confidence.begin(), surface.normals.confidence.end(), 1.0f);
    std::fill(surface.labels.begin(), surface.labels.end(), uint8_t{0});
    surface.height = Image(64, 64, 1);
    for (int y = 8; y < 56; ++y) {
        for (int x = 20; x < 40; ++x) {
            surface.height.values[surface.normals.index(x, y)] = 12.8f;
        }
    }
    surface.camera = glm::vec3(0.1f, -0.05f, 1.5f);
    return surface;
}

TEST(Lens, PlacesLieOnTheRaysOfTheirPixels)
{
    const Surface surface = stepBeforeLens();
    const std::vector<glm::vec3> places = pixelPlaces(surface);
    for (const glm::ivec2 pixel : {glm::ivec2(1, 60), {22, 10}, {39, 55}}) {
        const glm::vec3& place = places[surface.normals.index(pixel.x, pixel.y)];
        const glm::vec3 onPlane = glm::vec3(pixel.x + 0.5f - 32, 32 - pixel.y - 0.5f, 0) / 64.0f;
        EXPECT_NEAR(glm::length(glm::cross(place - onPlane, *surface.camera - onPlane)), 0, 1e-6);
        const glm::vec4 viewpoint = viewpointOf(surface, {0, 0, 1});
        EXPECT_NEAR(glm::distance(viewFromPlace(viewpoint, place), glm::normalize(*surface.camera - place)), 0, 1e-6);
    }
    EXPECT_EQ(viewpointOf(surface, {0.6f, 0, 0.8f}), glm::vec4(0.6f, 0, 0.8f, 0));
}

// Points of a ray lie on one line in the picture's scene, along which it leaves.
TEST(Lens, RaysStayStraightInThePicturesScene)
{
    const glm::vec3 camera(0.2f, -0.1f, 2), place(0.3f, 0.25f, 0.2f), axis(camera.x, camera.y, 0);
    const glm::vec4 viewpoint(glm::normalize(camera), 1 / glm::length(camera));
    const auto image = [&](const glm::vec3& x) { return axis + (x - axis) / (1 - x.z / camera.z); };
    for (const glm::vec3 ray : {glm::vec3(1, 0, 0), {0.3f, -0.5f, 0.8f}, {-0.7f, 0.2f, -0.3f}}) {
        const glm::vec3 l = glm::normalize(ray), towards = directionInPicture(viewpoint, place, l);
        for (const float t : {0.01f, 0.3f, 0.9f}) {
            EXPECT_NEAR(glm::distance(glm::normalize(image(place + t * l) - image(place)), towards), 0, 2e-4) << t;
        }
    }
    const glm::vec4 mapped = pointInPicture(viewpoint, glm::vec4(place, 1));
    EXPECT_NEAR(glm::distance(glm::vec3(mapped) / mapped.w, image(place)), 0, 1e-6);
    EXPECT_EQ(directionInPicture({0, 0, 1, 0}, place, {0.6f, 0, 0.8f}), glm::vec3(0.6f, 0, 0.8f));
}

TEST(Lens, ShadowsFallWhereRaysAreHidden)
{
    Surface surface = stepBeforeLens();
    surface.horizon = horizonMap(surface.normals, heightInPicture(surface));
    const glm::vec3 direction = glm::normalize(glm::vec3(0.7f, 0.3f, 0.6f));
    size_t hidden = 0;
    for (const float distance : {1.3f, std::numeric_limits<float>::infinity()}) {
        const std::vector<Light> lights{{direction, glm::vec3(1), distance}};
        const PixelLights met(surface, lights, {0, 0, 1});
        const glm::dvec4 light =
            isNear(lights[0]) ? glm::dvec4(64 * distance * direction, 1) : glm::dvec4(direction, 0);
        size_t differ = 0;
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                const bool isHidden = test::isHidden(surface.height, glm::dvec3(*surface.camera) * 64.0, x, y, light);
                hidden += isHidden;
                differ += isHidden != (met.at(0, surface.normals.index(x, y)).share < 0.5f);
            }
        }
        EXPECT_LT(differ, 0.03 * 64 * 64) << distance; // borders, by 32 azimuths
    }
    EXPECT_GT(hidden, 800u);
}

TEST(Lens, GoesThroughTheFile)
{
    const TempFolder folder;
    Surface surface = stepBeforeLens();
    saveSurface(folder / "s.nacre", surface, false);
    EXPECT_EQ(loadSurface(folder / "s.nacre").camera, surface.camera);
    surface.camera->z = 0.2f;
    saveSurface(folder / "s.nacre", surface, true);
    expectError([&] { loadSurface(folder / "s.nacre"); }, {"surface.json", "camera", "0.2", "inside"});
}

TEST(NearLight, DistancesGoThroughTheFile)
{
    const TempFolder folder;
    Surface surface = whitePlane();
    surface.lights = {{"a", {{0, 0, 1}, {1, 2, 3}}}, {"b", {{1, 0, 0}, {1, 1, 1}, 1.7f}}};
    saveSurface(folder / "s.nacre", surface, false);
    const Surface loaded = loadSurface(folder / "s.nacre");
    for (size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(loaded.lights[i].light, surface.lights[i].light);
    }
    surface.lights[1].light.distance = 0.3f;
    saveSurface(folder / "s.nacre", surface, true);
    expectError([&] { loadSurface(folder / "s.nacre"); }, {"surface.json", "lights[1].distance", "0.3", "inside"});
}

} // namespace
} // namespace nacre
