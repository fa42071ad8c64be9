// Lights near the object: places of pixels, pictures of a plane against the formula, files.
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/scene/reference.h"
#include "engine/surface/object_places.h"
#include "shared/brdf_coords.h"
#include "tests/support/expect_error.h"
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
