// Meshes seen by a distant camera: what is drawn against what is known of the shape.
#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "engine/brdf/brdf_models.h"
#include "engine/brdf/brdf_tabulation.h"
#include "engine/files/measures.h"
#include "engine/target/mesh_file.h"
#include "engine/target/mesh_raster.h"
#include "tests/gpu/gpu_test.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/target/meshes.h"

namespace nacre::test {
namespace {

class MeshRasterTest : public GpuTest {
protected:
    std::filesystem::path write(const std::string& name, const std::string& text)
    {
        writeText(folder_ / name, text);
        return folder_ / name;
    }

    static Surface view(const Mesh& mesh, const MeshViewOptions& options)
    {
        return rasterisedMesh(*context, mesh, fittedView(mesh, options));
    }

    TempFolder folder_;
};

float largestDifference(const Image& a, const Image& b)
{
    float largest = a.values.size() == b.values.size() ? 0 : 1;
    for (size_t i = 0; i < std::min(a.values.size(), b.values.size()); ++i) {
        largest = std::max(largest, std::abs(a.values[i] - b.values[i]));
    }
    return largest;
}

constexpr int kRasterSize = 256;
// Of the unit sphere in a picture of kRasterSize pixels with 4 % margins.
constexpr double kRadius = 0.46 * kRasterSize;

// Largest angle to the true sphere's normals, and largest difference of height, where the disc's radius is below 0.95.
// Beyond, a pixel holds more than a degree of the sphere.
std::pair<double, double> sphereErrors(const Surface& surface)
{
    double degrees = 0, pixels = 0;
    for (int y = 0; y < kRasterSize; ++y) {
        for (int x = 0; x < kRasterSize; ++x) {
            const glm::dvec2 disc((x + 0.5 - kRasterSize / 2.0) / kRadius, (kRasterSize / 2.0 - y - 0.5) / kRadius);
            if (glm::length(disc) < 0.95) {
                const size_t i = surface.normals.index(x, y);
                const double z = std::sqrt(1 - glm::dot(disc, disc));
                EXPECT_EQ(surface.normals.confidence[i], 1);
                degrees = std::max(degrees, degreesBetween(surface.normals.normals[i], glm::vec3(disc, z)));
                pixels = std::max(pixels, std::abs(surface.height.values[i] - kRadius * z));
            }
        }
    }
    return {degrees, pixels};
}

// Whatever normals and winding the file has. A ring of 0.9 degrees bends 0.005 degrees away from its chord.
TEST_F(MeshRasterTest, ASpheresNormalsAreTheSpheres)
{
    for (const bool withNormals : {true, false}) {
        for (const bool reversed : {false, true}) {
            SCOPED_TRACE(testing::Message() << "normals " << withNormals << ", reversed " << reversed);
            const Mesh mesh = loadMesh(write("ball.obj", sphereObj(200, withNormals, reversed)));
            EXPECT_EQ(mesh.normalsWereMade, !withNormals);
            const auto [degrees, pixels] = sphereErrors(view(mesh, {.width = kRasterSize, .height = kRasterSize}));
            EXPECT_LT(degrees, 0.2);
            EXPECT_LT(pixels, 0.05) << "of height";
            RecordProperty("degrees", std::to_string(degrees));
        }
    }
}

TEST_F(MeshRasterTest, LooksFromWhereItIsAsked)
{
    // A square that faces +x: from there it is seen flat, its y up.
    const Mesh mesh =
        loadMesh(write("side.obj", "v 0 -1 -1\nv 0 1 -1\nv 0 1 1\nv 0 -1 1\nv 0 2 0\nf 1 2 3 4\nf 2 5 3\n"));
    const Surface surface = view(mesh, {.from = {2, 0, 0}, .up = {0, 1, 0}, .width = 60, .height = 60});
    EXPECT_NEAR(glm::distance(surface.normals.normals[surface.normals.index(30, 30)], glm::vec3(0, 0, 1)), 0, 1e-4);
    EXPECT_EQ(surface.labels[surface.normals.index(30, 5)], 0) << "the roof is up";
    EXPECT_EQ(surface.labels[surface.normals.index(15, 5)], Surface::kNoMaterial);
    EXPECT_EQ(surface.labels[surface.normals.index(30, 55)], 0);
    expectError([&] { view(mesh, {.from = {0, 0, 1}}); }, {"edge-on", "another direction"});
    expectError(
        [&] {
            view(mesh, {.from = {0, 1, 0}, .up = {0, 3, 0}});
        },
        {"is no direction across", "parallel"}, Error::kUsage);
    expectError([&] { view(mesh, {.from = {1, 0, 0}, .width = 1 << 20}); }, {"cannot draw"});
}

// Of two squares one before the other, the front one is seen where both are, whatever their order in the file.
TEST_F(MeshRasterTest, TheNearestPartWins)
{
    const std::string vertices = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\n"
                                 "v -0.5 -0.5 1\nv 0.5 -0.5 1\nv 0.5 0.5 1\nv -0.5 0.5 1\n";
    const std::string farther = "o far\nf 1 2 3 4\n", nearer = "o near\nf 5 6 7 8\n";
    for (const std::string& text : {vertices + farther + nearer, vertices + nearer + farther}) {
        const Surface surface = view(loadMesh(write("two.obj", text)), {.width = 100, .height = 100});
        ASSERT_EQ(surface.parts.size(), 2u);
        const auto partAt = [&](int x, int y) { return surface.parts[surface.labels[surface.normals.index(x, y)]]; };
        EXPECT_EQ(partAt(50, 50), "near");
        EXPECT_EQ(partAt(10, 50), "far");
        // 92 % of 100 pixels are 2 units, and so is the depth between the two.
        EXPECT_NEAR(surface.height.at(50, 50) - surface.height.at(10, 50), 92, 0.01);
        EXPECT_EQ(surface.labels[0], Surface::kNoMaterial);
        EXPECT_EQ(surface.height.values[0], 0);
    }
}

// A square that shows a normal map shows the map's normals, turned as its texture coordinates are.
TEST_F(MeshRasterTest, NormalMapsFollowTheTextureCoordinates)
{
    const glm::vec3 tilted = glm::normalize(glm::vec3(0.3f, 0.5f, 0.8f));
    NormalMap map(8, 8);
    std::fill(map.normals.begin(), map.normals.end(), tilted);
    std::fill(map.confidence.begin(), map.confidence.end(), 1.0f);
    saveNormalMap(folder_ / "map.exr", map);
    // Texture coordinates that run on by a quarter turn lay the picture turned back by one.
    const glm::vec3 expected[] = {tilted, {tilted.y, -tilted.x, tilted.z}, {-tilted.x, -tilted.y, tilted.z}};
    for (int turns = 0; turns < 3; ++turns) {
        for (const bool mirrored : {false, true}) {
            SCOPED_TRACE(testing::Message() << turns << (mirrored ? " mirrored" : ""));
            const auto file = write("square.obj", squareObj(turns, mirrored));
            const Surface surface = view(loadMesh(file, {folder_ / "map.exr"}), {.width = 40, .height = 40});
            // Mirrored, u runs against the picture before it is turned: x of the map changes sign first.
            const glm::vec3 m = mirrored ? glm::vec3(-tilted.x, tilted.y, tilted.z) : tilted;
            const glm::vec3 turned[] = {m, {m.y, -m.x, m.z}, {-m.x, -m.y, m.z}};
            EXPECT_LT(degreesBetween(surface.normals.normals[surface.normals.index(20, 20)], turned[turns]), 0.01);
            EXPECT_TRUE(mirrored || turned[turns] == expected[turns]);
        }
    }
    const auto file = write("square.obj", squareObj(0, false));
    const Surface dx = view(loadMesh(file, {folder_ / "map.exr", NormalY::dx}), {.width = 40, .height = 40});
    EXPECT_LT(degreesBetween(dx.normals.normals[dx.normals.index(20, 20)], {tilted.x, -tilted.y, tilted.z}), 0.01);
}

// Left half leans left, right half right; v grows upwards while rows go down.
TEST_F(MeshRasterTest, NormalMapsLieTheRightWayRound)
{
    NormalMap map(64, 64);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            map.normals[map.index(x, y)] = glm::normalize(glm::vec3(x < 32 ? -1 : 1, y < 32 ? 1 : -1, 2));
            map.confidence[map.index(x, y)] = 1;
        }
    }
    saveNormalMap(folder_ / "map.exr", map);
    const Mesh mesh = loadMesh(write("square.obj", squareObj(0, false)), {folder_ / "map.exr"});
    const Surface surface = view(mesh, {.width = 100, .height = 100});
    for (const int x : {25, 75}) {
        for (const int y : {25, 75}) {
            const glm::vec3 n = surface.normals.normals[surface.normals.index(x, y)];
            EXPECT_EQ(n.x > 0, x > 50) << x << " " << y;
            EXPECT_EQ(n.y > 0, y < 50) << x << " " << y;
        }
    }
}

// More triangles than one upload holds, drawn over each other: nothing is lost between uploads.
TEST_F(MeshRasterTest, ManyUploadsAreOnePicture)
{
    const Mesh mesh = loadMesh(write("ball.obj", sphereObj(300, true)));
    ASSERT_GT(mesh.triangleCount(), size_t{1} << 17);
    const auto [degrees, pixels] = sphereErrors(view(mesh, {.width = kRasterSize, .height = kRasterSize}));
    EXPECT_LT(degrees, 0.2);
    EXPECT_LT(pixels, 0.05);
}

// A direct view from where a turn brings the viewer shows the same, as large and centred where it fits alike.
TEST_F(MeshRasterTest, ATurnIsAViewFromElsewhere)
{
    const Mesh mesh = loadMesh(write("octahedron.obj", "v 1 0 0\nv -1 0 0\nv 0 2 0\nv 0 -2 0\nv 0 0 3\nv 0 0 -3\n"
                                                       "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\n"
                                                       "f 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n"));
    for (const auto& [turn, from] :
         {std::pair(Turn{.yaw = 90}, glm::vec3(-1, 0, 0)), std::pair(Turn{.yaw = -90}, glm::vec3(1, 0, 0)),
          std::pair(Turn{.yaw = 180}, glm::vec3(0, 0, -1))}) {
        const MeshView turned = fittedView(mesh, {.turn = turn}), direct = fittedView(mesh, {.from = from});
        const double scale = turned.pixelsPerUnit / direct.pixelsPerUnit;
        EXPECT_LE(scale, 1 + 1e-12) << "all of it is seen";
        for (const glm::vec3& p : mesh.positions) {
            const glm::dvec3 a = turned.pixelPoint(p), b = direct.pixelPoint(p), middle(512, 512, 0);
            EXPECT_LT(glm::length((a - middle) - scale * (b - middle)), 1e-6);
        }
    }
}

TEST_F(MeshRasterTest, CoarselyItIsNearlyTheSameAndFinelyTheSameAfterwards)
{
    const auto mesh = std::make_shared<const Mesh>(loadMesh(write("sphere.obj", sphereObj(200, true))));
    const MeshView seen = fittedView(*mesh, {.width = kRasterSize, .height = kRasterSize});
    MeshRaster raster(*context, mesh, kRasterSize, kRasterSize);
    const Surface before = raster.draw(seen), coarse = raster.draw(seen, true), after = raster.draw(seen);
    EXPECT_EQ(before.normals.normals, after.normals.normals);
    EXPECT_EQ(before.height.values, after.height.values);
    EXPECT_LT(sphereErrors(coarse).first, 1);
}

TEST_F(MeshRasterTest, AZoomShowsAPartOfTheView)
{
    const Mesh mesh = loadMesh(write("sphere.obj", sphereObj(10, true)));
    const MeshView whole = fittedView(mesh, {.width = 300, .height = 200, .turn = {.yaw = 20}});
    const Zoom zoom{.scale = 2.5f, .origin = {40.5f, 17}, .size = {301, 97}};
    const MeshView part = zoomedView(whole, zoom);
    EXPECT_EQ(glm::ivec2(part.width, part.height), zoom.size);
    for (const glm::vec3& p : mesh.positions) {
        const glm::dvec3 expected = 2.5 * (whole.pixelPoint(p) - glm::dvec3(zoom.origin, 0));
        EXPECT_LT(glm::length(part.pixelPoint(p) - expected), 1e-6);
        EXPECT_LE(part.pixelPoint(p).z, part.nearest + 1e-6);
        EXPECT_GE(part.pixelPoint(p).z, part.farthest - 1e-6);
    }
}

// Pixels that never leave the device against the same samples that were read back; and nothing is left of them after.
TEST_F(MeshRasterTest, PixelsOnTheDeviceAreDrawnAsThoseReadBack)
{
    const auto mesh = std::make_shared<const Mesh>(loadMesh(write("sphere.obj", sphereObj(60, true))));
    const MeshView view = fittedView(*mesh, {.width = kRasterSize, .height = kRasterSize});
    const Zoom zoom{.scale = 1.75f, .origin = {3, 70}, .size = {kRasterSize, kRasterSize}};
    MeshRaster raster(*context, mesh, kRasterSize, kRasterSize);
    const std::vector<Light> lights = {{.direction = glm::normalize(glm::vec3(0.4f, 0.5f, 0.8f))}};
    const auto rendererOf = [&](const Surface& seen) {
        Surface surface = transferredSurface(
            seen, {"matte", tabulatedBrdf(LambertGgx{.specular = glm::vec3(0.04f)}, {16, 16, 16}, {}, 1), {}});
        auto renderer = std::make_unique<Renderer>(*context);
        renderer->setSurface(std::move(surface), {{.radiance = 128, .display = 1024}});
        renderer->setLights(lights);
        return renderer;
    };
    const auto atRest = rendererOf(raster.draw(view));
    const Image before = atRest->picture();
    atRest->setZoom(zoom);
    const Image magnified = atRest->picture();
    ASSERT_TRUE(atRest->drawsFromDevice(lights));
    const auto readBack = rendererOf(raster.draw(zoomedView(view, zoom), true));
    for (const Show show : {Show::picture, Show::normals}) {
        atRest->setShow(show);
        readBack->setShow(show);
        for (int time = 0; time < 2; ++time) { // over what was drawn before
            atRest->setDevicePixels(raster.drawPixels(zoomedView(view, zoom)));
            // 16 bits hold a normal less finely than the device's 32: it may read the ball's next texel.
            EXPECT_LE(largestDifference(atRest->picture(), readBack->picture()), 2.5f / 255);
        }
    }
    atRest->setShow(Show::picture);
    const Frame radiance = atRest->radiance();
    atRest->setPixels(raster.draw(view));
    EXPECT_EQ(atRest->picture().values, magnified.values);
    EXPECT_EQ(atRest->radiance().values, radiance.values) << "which is never of the device's";
    atRest->setZoom({});
    EXPECT_EQ(atRest->picture().values, before.values);
    const std::vector<Light> near = {{.direction = lights[0].direction, .distance = 2}};
    EXPECT_FALSE(atRest->drawsFromDevice(near)) << "near lights ask where a pixel lies";
}

TEST_F(MeshRasterTest, PitchBringsTheTopNearerAndRollIsCounterClockwise)
{
    const auto turned = [](const Turn& turn, const glm::dvec3& v) { return matrixOf(turn) * v; };
    EXPECT_GT(turned({.pitch = 30}, {0, 1, 0}).z, 0);
    EXPECT_GT(turned({.yaw = 30}, {0, 0, 1}).x, 0);
    EXPECT_GT(turned({.roll = 30}, {1, 0, 0}).y, 0);
    const glm::dmat3 any = matrixOf({.yaw = 40, .pitch = -70, .roll = 110});
    EXPECT_NEAR(glm::determinant(any), 1, 1e-12);
    EXPECT_EQ(turnFromText(textOf(Turn{.yaw = 40.25f, .pitch = -70, .roll = 110})),
              (Turn{.yaw = 40.25f, .pitch = -70, .roll = 110}));
}

} // namespace
} // namespace nacre::test
