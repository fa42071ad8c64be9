// nacre target as its users start it: each kind of source, what is said of it, and what is refused with which exit
// code.
#include <algorithm>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/files/measures.h"
#include "engine/scene/reference.h"
#include "engine/surface/surface.h"
#include "tests/gpu/frame_match.h"
#include "tests/gpu/scenes.h"
#include "tests/support/data_folder.h"
#include "tests/support/expect_one_line.h"
#include "tests/support/run_nacre.h"

namespace nacre::test {
namespace {
namespace fs = std::filesystem;

constexpr const char* kSquare = "o tile\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n";

class TargetCommandTest : public testing::Test {
protected:
    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    std::string write(const std::string& name, const std::string& text)
    {
        writeText(folder_ / name, text);
        return path(name);
    }

    ProgramRun target(const std::string& source, std::vector<std::string> more = {})
    {
        std::vector<std::string> arguments = {"target", source, "-o", path("new.nacre")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runNacre(arguments);
    }

    void expectRefusal(const ProgramRun& run, int exitCode, const std::vector<std::string>& fragments)
    {
        expectOneLine(run, exitCode, fragments);
        EXPECT_FALSE(fs::exists(path("new.nacre")));
    }

    // A sphere's normals as n = 2 v - 1, its green pointing down where asked.
    std::string writeSphere(const std::string& name, bool greenDown)
    {
        NormalMap sphere = sphereNormalMap(128);
        for (glm::vec3& n : sphere.normals) {
            n.y *= greenDown ? -1.0f : 1.0f;
        }
        saveNormalMap(folder_ / name, sphere);
        return path(name);
    }

    TempFolder folder_;
};

TEST_F(TargetCommandTest, AMeshTakesAMaterial)
{
    const ProgramRun run = target(write("tile.obj", kSquare), {"--size", "60x40"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_EQ(run.err, "");
    for (const char* fragment :
         {"2 triangles", "1 part", "60x40", "tile", "read ", "rasterise ", "write ", "in all "}) {
        EXPECT_NE(run.out.find(fragment), std::string::npos) << fragment << " is not in " << run.out;
    }
    const ProgramRun render = runNacre({"render", "--material", "lambert:0.5", "--onto", path("new.nacre"), "--light",
                                        "0,0,1,2,2,2", "-o", path("a.exr")});
    ASSERT_EQ(render.exitCode, 0) << render.err;
    EXPECT_NEAR(loadImage(path("a.exr")).at(30, 20), 0.5 / 3.14159265 * 2, 1e-3);
}

// A mesh that is drawn at once, not turned, is the target that was made of it; turned it is another.
TEST_F(TargetCommandTest, MeshesAreDrawnAsTheirTargetsAre)
{
    const std::string mesh = write("roof.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 0.3 0.1 0.7\n"
                                               "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
    ASSERT_EQ(target(mesh, {"--size", "60x40"}).exitCode, 0);
    const auto drawn = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {"render",      "--material", "ggx:diffuse=0.3;alpha=0.3",
                                              "--light",     "0.3,0.4,1",  "-o",
                                              path("a.exr"), "--force"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramRun run = runNacre(arguments);
        EXPECT_EQ(run.exitCode, 0) << run.err;
        return loadImage(path("a.exr")).values;
    };
    const std::vector<float> still = drawn({"--onto", mesh, "--size", "60x40"});
    EXPECT_EQ(still, drawn({"--onto", path("new.nacre")}));
    EXPECT_EQ(still, drawn({"--onto", mesh, "--size", "60x40", "--turn", "360,0"}));
    EXPECT_NE(still, drawn({"--onto", mesh, "--size", "60x40", "--turn", "20,0"}));
}

TEST_F(TargetCommandTest, WithoutAMaterialRenderSaysWhatIsMissing)
{
    ASSERT_EQ(target(write("tile.obj", kSquare), {"--size", "60x40"}).exitCode, 0);
    const ProgramRun run = runNacre({"render", path("new.nacre"), "-o", path("a.png")});
    EXPECT_EQ(run.exitCode, 3);
    EXPECT_NE(run.err.find("is a target without a material"), std::string::npos) << run.err;
    const ProgramRun info = runNacre({"info", path("new.nacre")});
    EXPECT_EQ(info.exitCode, 0);
    EXPECT_NE(info.out.find("60x40"), std::string::npos) << info.out;
}

TEST_F(TargetCommandTest, EverySourceBecomesASurface)
{
    Image ramp(64, 48, 1);
    for (size_t i = 0; i < ramp.values.size(); ++i) {
        ramp.values[i] = static_cast<float>(i % 64) / 63;
    }
    saveImage(folder_ / "ramp.png", ramp, PixelType::uint16);
    saveSurface(folder_ / "acquired.nacre", glossyScene(60, 40).surface, false);
    const std::vector<std::vector<std::string>> sources = {{path("ramp.png"), "--height-scale", "10"},
                                                           {writeSphere("sphere.png", false)},
                                                           {path("acquired.nacre")},
                                                           {"make:sphere", "--size", "64x64"}};
    for (const auto& source : sources) {
        SCOPED_TRACE(source[0]);
        std::vector<std::string> more(source.begin() + 1, source.end());
        more.push_back("--force");
        const ProgramRun run = target(source[0], more);
        ASSERT_EQ(run.exitCode, 0) << run.err;
        EXPECT_EQ(run.err, "");
        const Surface surface = loadSurface(path("new.nacre"));
        EXPECT_FALSE(surface.parts.empty());
        EXPECT_EQ(surface.height.values.size(), surface.normals.normals.size());
    }
}

TEST_F(TargetCommandTest, FlippedGreenIsSaidAndNotTurned)
{
    const std::string flipped = writeSphere("down.png", true);
    const ProgramRun run = target(flipped);
    ASSERT_EQ(run.exitCode, 0);
    EXPECT_NE(run.err.find("--normal-y dx"), std::string::npos) << run.err;
    EXPECT_LT(loadSurface(path("new.nacre")).normals.normals[20 * 128 + 64].y, 0) << "as it was given";
    const ProgramRun told = target(flipped, {"--normal-y", "dx", "--force"});
    EXPECT_EQ(told.err, "");
    EXPECT_GT(loadSurface(path("new.nacre")).normals.normals[20 * 128 + 64].y, 0);
    EXPECT_EQ(target(writeSphere("up.png", false), {"--force"}).err, "");
}

TEST_F(TargetCommandTest, WarnsOfWhatWasLeftOutAndOfTerraces)
{
    const ProgramRun mesh = target(write("a.obj", std::string(kSquare) + "v nan 0 0\nf 1 2 2\nf 1 2 5\n"));
    EXPECT_EQ(mesh.exitCode, 0);
    EXPECT_NE(mesh.err.find("1 triangles without an area"), std::string::npos) << mesh.err;
    EXPECT_NE(mesh.err.find("1 triangles with a vertex that is no number"), std::string::npos) << mesh.err;
    saveImage(folder_ / "grey.png", Image(32, 32, 1, 0.5f), PixelType::uint8);
    EXPECT_NE(target(path("grey.png"), {"--force"}).err.find("terraces"), std::string::npos);
}

TEST_F(TargetCommandTest, BadSourcesAreDataErrors)
{
    expectRefusal(target(path("none.obj")), 3, {"none.obj", "does not exist"});
    expectRefusal(target(path("none.png")), 3, {"none.png", "does not exist", "make:NAME"});
    expectRefusal(target(write("a.fbx", "x")), 3, {"a.fbx", "nothing that a target can be made of", ".obj, .ply"});
    expectRefusal(target(write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\n")), 3, {"a.obj", "no faces"});
    expectRefusal(target(write("b.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")), 3, {"b.obj", "no usable face"});
    expectRefusal(target(write("d.obj", kSquare), {"--normal-map", writeSphere("map.png", false)}), 3,
                  {"d.obj", "no texture coordinates"});
    expectRefusal(target(write("e.obj", kSquare), {"--from", "1,0,0"}), 3, {"edge-on", "another direction"});
    expectRefusal(target(write("f.obj", kSquare), {"--size", "99999x99999"}), 3, {"cannot draw"});
    expectRefusal(target(write("g.png", "no picture")), 3, {"g.png", "cannot be read"});
    fs::create_directory(folder_ / "empty");
    expectRefusal(target(path("empty")), 3, {"empty", "is not a surface"});
}

TEST_F(TargetCommandTest, BadOptionsAreUsageErrors)
{
    const std::string mesh = write("a.obj", kSquare), sphere = writeSphere("map.png", false);
    expectRefusal(target(mesh, {"--from", "0,0,0"}), 2, {"--from 0,0,0", "not all 0"});
    expectRefusal(target(mesh, {"--from", "0,0"}), 2, {"--from 0,0", "x,y,z"});
    expectRefusal(target(mesh, {"--from", "0,1,1", "--up", "0,2,2"}), 2, {"up 0,2,2", "from 0,1,1", "parallel"});
    expectRefusal(target(mesh, {"--size", "60"}), 2, {"WIDTHxHEIGHT"});
    expectRefusal(target(mesh, {"--height-scale", "5"}), 2, {"--height-scale", "a mesh"});
    expectRefusal(target(mesh, {"--normal-y", "up"}), 2, {"gl (green points up)"});
    expectRefusal(target(sphere, {"--from", "1,0,0"}), 2, {"--from", "no mesh"});
    expectRefusal(target(sphere, {"--height-scale", "five"}), 2, {"height scale five"});
    expectRefusal(target("make:nothing"), 2, {"nothing"});
    expectRefusal(runNacre({"target", mesh, "-o", path("a.png")}), 2, {"NAME.nacre"});
    ASSERT_EQ(target(mesh).exitCode, 0);
    const ProgramRun again = target(mesh);
    EXPECT_EQ(again.exitCode, 3);
    EXPECT_NE(again.err.find("--force"), std::string::npos) << again.err;
}

// The statue that the task is measured by, and the cloths whose green was turned by nobody.
TEST_F(TargetCommandTest, RealTargetsAreTaken)
{
    NACRE_REQUIRE_DATA("targets");
    const fs::path data = dataFolder() / "targets";
    const ProgramRun statue = target(data / "Hermes.obj", {"--normal-map", data / "Hermes_normals.png"});
    EXPECT_EQ(statue.exitCode, 0) << statue.err;
    EXPECT_EQ(statue.err, "");
    for (const char* name : {"godot_wool_normal.png", "polyhaven_dutch_ship_medium_sails_nor_gl_1k.jpg"}) {
        EXPECT_EQ(target(data / name, {"--force"}).err, "");
        NormalMap map = loadNormalMap(data / name, NormalY::dx);
        saveNormalMap(folder_ / "flipped.png", map);
        EXPECT_NE(target(path("flipped.png"), {"--force"}).err.find("--normal-y dx"), std::string::npos) << name;
    }
}

} // namespace
} // namespace nacre::test
