// nacre transfer and nacre materials as their users start them.
#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/brdf/brdf_tabulation.h"
#include "engine/files/whole_file.h"
#include "engine/materials/material_specification.h"
#include "engine/materials/merl_file.h"
#include "engine/surface/surface.h"
#include "tests/support/expect_one_line.h"
#include "tests/support/run_nacre.h"

namespace nacre::test {
namespace {
namespace fs = std::filesystem;

constexpr const char* kRig = R"({"format": "nacre lights", "version": 1, "lights": [
    {"direction": [0.3, 0.4, 0.87], "irradiance": [1, 1, 1]}, {"direction": [-0.5, 0, 0.87], "irradiance": [1, 0.5, 0.25]}]})";
constexpr const char* kTwoTiles = "o left\nv -1 -1 0\nv 0 -1 0\nv 0 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n"
                                  "o right\nv 0 -1 0\nv 1 -1 0\nv 1 1 0\nv 0 1 0\nf 5 6 7\nf 5 7 8\n";

class LibraryTest : public testing::Test {
protected:
    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    std::string write(const std::string& name, const std::string& text)
    {
        writeText(folder_ / name, text);
        return path(name);
    }

    // A glossy table that was measured for thetaD up to 22.5 degrees alone: lights within 45 degrees of the view.
    static Material frontMaterial(const std::string& name, const glm::vec3& diffuse)
    {
        const LambertGgx model{diffuse, glm::vec3(0.04f), 0.3f};
        return {name, tabulatedBrdf(model, {32, 12, 12}, {kHalfDifference, kHalfPi / 4}), {}};
    }

    std::string saveMaterials(const std::string& name, const std::vector<std::string>& names)
    {
        Surface surface = transferredSurface(sphereNormalMap(16), frontMaterial(names[0], {0.5f, 0.1f, 0.1f}));
        for (size_t i = 1; i < names.size(); ++i) {
            surface.materials.push_back(frontMaterial(names[i], {0.1f, 0.5f, 0.1f}));
        }
        saveSurface(folder_ / name, surface, false);
        return path(name);
    }

    ProgramRun transfer(std::vector<std::string> more, const std::string& size = "64x48")
    {
        std::vector<std::string> arguments = {"transfer", "-o", path("out"), "--size", size};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runNacre(arguments);
    }

    void expectRefusal(const ProgramRun& run, int exitCode, const std::vector<std::string>& fragments)
    {
        expectOneLine(run, exitCode, fragments);
        EXPECT_FALSE(fs::exists(path("out")));
        EXPECT_FALSE(fs::exists(path("out.nacre")));
        EXPECT_FALSE(fs::exists(path("out.png")));
    }

    TempFolder folder_;
};

// The same pipeline by another door.
TEST_F(LibraryTest, APictureIsThatOfRender)
{
    const std::string material = saveMaterials("a.nacre", {"skin"});
    const ProgramRun run =
        transfer({"--materials", material, "--onto", "make:head", "--rig", write("rig.json", kRig) + "#1"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    ASSERT_EQ(runNacre({"target", "make:head", "--size", "64x48", "-o", path("head.nacre")}).exitCode, 0);
    const ProgramRun render = runNacre({"render", "--material", material, "--onto", path("head.nacre"),
                                        "--light=0.3,0.4,0.87", "--path", "direct", "-o", path("render.png")});
    ASSERT_EQ(render.exitCode, 0) << render.err;
    EXPECT_EQ(loadImage(path("out/rig-1_a_on_head.png")).values, loadImage(path("render.png")).values);
}

TEST_F(LibraryTest, MeshesAreTurnedAsRenderTurnsThem)
{
    const std::string mesh = write("roof.obj", "v -1 0 0\nv 1 0 0\nv 0 1 0.5\nv 0 -1 0.2\nf 1 2 3\nf 2 1 4\n");
    const std::string material = saveMaterials("a.nacre", {"skin"});
    const ProgramRun run =
        transfer({"--materials", material, "--onto", mesh, "--turn", "30,10", "--rig", write("rig.json", kRig) + "#1"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const auto render = [&](const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {
            "render",  "--material",           material, "--onto", mesh, "--size",  "64x48",
            "--quiet", "--light=0.3,0.4,0.87", "--path", "direct", "-o", path(name)};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_EQ(runNacre(arguments).exitCode, 0);
    };
    render("turned.png", {"--turn", "30,10"});
    EXPECT_EQ(loadImage(path("out/rig-1_a_on_roof.png")).values, loadImage(path("turned.png")).values);
    render("still.png", {});
    EXPECT_NE(loadImage(path("still.png")).values, loadImage(path("turned.png")).values);

    render("around.png", {"--frames", "4", "--motion", "object", "--turn", "30,10", "--exposure", "0"});
    for (int frame = 0; frame < 4; ++frame) {
        render("one.png", {"--turn", std::to_string(30 + 90 * frame) + ",10", "--exposure", "0", "--force"});
        EXPECT_EQ(loadImage(path("around_000" + std::to_string(frame + 1) + ".png")).values,
                  loadImage(path("one.png")).values)
            << frame;
    }
}

TEST_F(LibraryTest, OtherShapesAreTurnedAsReliefsOfTheirHeights)
{
    const std::string material = saveMaterials("a.nacre", {"skin"});
    const auto render = [&](const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {"render", "--material", material,  "--onto",  "make:head",
                                              "--size", "64x48",      "--quiet", "--force", "--light=0.3,0.4,0.87",
                                              "--path", "direct",     "-o",      path(name)};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_EQ(runNacre(arguments).exitCode, 0);
        return path(name);
    };
    const ProgramRun run = transfer(
        {"--materials", material, "--onto", "make:head", "--turn", "30,10", "--rig", write("rig.json", kRig) + "#1"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_EQ(loadImage(path("out/rig-1_a_on_head.png")).values,
              loadImage(render("turned.png", {"--turn", "30,10"})).values);

    render("sway.png", {"--frames", "4", "--motion", "object", "--exposure", "0"});
    const char* const turns[] = {"0,0", "40,0", "0,0", "-40,0"};
    for (int frame = 0; frame < 4; ++frame) {
        const Image expected = loadImage(render("one.png", {"--turn=" + std::string(turns[frame]), "--exposure", "0"}));
        EXPECT_EQ(loadImage(path("sway_000" + std::to_string(frame + 1) + ".png")).values, expected.values) << frame;
    }
}

TEST_F(LibraryTest, ListsMayHoldNamesWithCommas)
{
    saveMaterials("coin, obverse.nacre", {"gold"});
    saveMaterials("wax.nacre", {"wax"});
    const std::string both = path("coin, obverse.nacre") + "," + path("wax.nacre");
    for (const std::string& materials : {both, path("wax.nacre") + "," + path("coin, obverse.nacre")}) {
        fs::remove_all(path("out"));
        const ProgramRun run = transfer({"--materials", materials, "--onto", "make:sphere", "--rig", "key"});
        EXPECT_EQ(run.exitCode, 0) << run.err;
        EXPECT_TRUE(fs::exists(path("out/key_wax_on_sphere.png"))) << materials;
    }
}

TEST_F(LibraryTest, EveryRigHasASheetOfEveryMaterialOnEveryTarget)
{
    const ProgramRun run = transfer({"--materials", "lambert:0.5,0.2,0.1,lambert:0.3", "--materials", "ggx:alpha=0.5",
                                     "--onto", "make:sphere,make:cloth:twill,threads=8", "--rig", "key,raking"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_EQ(run.err, "");
    for (const std::string rig : {"key", "raking"}) {
        // Three columns of 64 pixels, three rows of 48 with their captions.
        const Image sheet = loadImage(path("out/sheet_" + rig + ".png"));
        EXPECT_GE(sheet.width, 3 * 64);
        EXPECT_LT(sheet.width, 4 * 64);
        EXPECT_GE(sheet.height, 3 * 48);
        for (const std::string material : {"lambert-0.5-0.2-0.1", "lambert-0.3", "ggx-alpha-0.5"}) {
            for (const std::string target : {"ball", "on_sphere", "on_cloth-twill-threads-8"}) {
                EXPECT_TRUE(fs::exists(path("out/" + rig + "_" + material + "_" + target + ".png"))) << target;
            }
        }
    }
    for (const char* stage : {"device ", "materials ", "targets ", "pictures ", "in all "}) {
        EXPECT_NE(run.out.find(stage), std::string::npos) << stage << " is not in " << run.out;
    }
}

// A front light asks for nothing, one from the side for what was never measured; the stripes stand where it does.
TEST_F(LibraryTest, UncertainPicturesAreSaidAndHatched)
{
    const std::string material = saveMaterials("a.nacre", {"skin"});
    const std::vector<std::string> arguments{"--materials", material, "--onto", "make:sphere", "--rig"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), arguments.begin(), arguments.end());
        more.push_back("--force");
        return transfer(more);
    };
    const std::string front = write("front.json", R"({"format": "nacre lights", "version": 1, "lights": [
        {"direction": [0, 0.1, 1]}]})");
    const ProgramRun measured = with({front});
    ASSERT_EQ(measured.exitCode, 0) << measured.err;
    const ProgramRun raking = with({"raking"});
    ASSERT_EQ(raking.exitCode, 0) << raking.err;
    EXPECT_NE(raking.out.find("100.0 % of this picture is uncertain"), std::string::npos) << raking.out;
    const Image plain = loadImage(path("out/raking_a_on_sphere.png"));
    ASSERT_EQ(with({"raking", "--hatch"}).exitCode, 0);
    const Image hatched = loadImage(path("out/raking_a_on_sphere.png"));
    const auto isMagenta = [](const glm::vec3& c) { return c.x > c.y + 0.2f && c.z > c.y + 0.2f; };
    size_t stripes = 0;
    for (int y = 0; y < plain.height; ++y) {
        for (int x = 0; x < plain.width; ++x) {
            EXPECT_FALSE(isMagenta(plain.rgb(x, y)));
            stripes += isMagenta(hatched.rgb(x, y));
        }
    }
    EXPECT_GT(stripes, 100u);
}

TEST_F(LibraryTest, PartsWearMaterialsOfTheirOwn)
{
    const ProgramRun run = transfer(
        {"--labels", "1=lambert:0.8,0,0,2=lambert:0,0,0.8", "--onto", write("tiles.obj", kTwoTiles), "--rig", "key"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const Image picture = loadImage(path("out/key_labels_on_tiles.png"));
    const glm::vec3 left = picture.rgb(20, 24), right = picture.rgb(44, 24);
    EXPECT_GT(left.x, 0.5f);
    EXPECT_EQ(left.z, 0);
    EXPECT_GT(right.z, 0.5f);
    EXPECT_EQ(right.x, 0);
}

TEST_F(LibraryTest, ASweepIsNumberedPicturesAndAnAnimation)
{
    const std::vector<std::string> arguments{"--materials", "lambert:0.5", "--onto", "make:sphere", "--rig", "key"};
    std::vector<std::string> moving = arguments;
    moving.insert(moving.end(), {"--frames", "3", "--motion", "sweep"});
    const ProgramRun run = transfer(moving);
    ASSERT_EQ(run.exitCode, 0) << run.err;
    std::vector<Image> frames;
    for (const char* number : {"0001", "0002", "0003"}) {
        frames.push_back(loadImage(path(std::string("out/key_lambert-0.5_on_sphere_") + number + ".png")));
    }
    EXPECT_NE(frames[0].values, frames[1].values);
    EXPECT_NE(frames[1].values, frames[2].values);
    EXPECT_GT(fs::file_size(path("out/key_lambert-0.5_on_sphere.webp")), 100u);
    EXPECT_TRUE(fs::exists(path("out/sheet_key.png")));
}

TEST_F(LibraryTest, TheSameBytesForAnyNumberOfThreads)
{
    const std::string material = saveMaterials("a.nacre", {"skin"});
    std::vector<std::string> sheets;
    for (const char* threads : {"1", "2"}) {
        ASSERT_EQ(transfer({"--materials", material, "--onto", "make:head", "--rig", "environment", "--threads",
                            threads, "--force"})
                      .exitCode,
                  0);
        sheets.push_back(readWholeFile(path("out/sheet_environment.png"), "a sheet"));
    }
    EXPECT_EQ(sheets[0], sheets[1]);
}

TEST_F(LibraryTest, WhatCannotBeTransferredIsRefusedWhole)
{
    const std::string good = saveMaterials("a.nacre", {"skin"});
    const auto refused = [&](const std::vector<std::string>& more, int code, const std::vector<std::string>& parts) {
        expectRefusal(transfer(more), code, parts);
    };
    refused({"--materials", good + "#tail", "--onto", "make:sphere"}, 2, {"#tail", "#1 (skin)"});
    refused({"--materials", "silk", "--onto", "make:sphere"}, 2, {"silk", "NAME.nacre", "merl-abc:"});
    refused({"--materials", good, "--onto", "make:moon"}, 2, {"moon", "sphere"});
    refused({"--materials", good, "--onto", path("none.obj")}, 3, {"none.obj", "does not exist"});
    refused({"--materials", good, "--onto", "make:sphere", "--rig", "moonlight"}, 2, {"moonlight", "three-point"});
    refused({"--materials", good, "--onto", "make:sphere", "--rig", "none.json"}, 3, {"none.json", "does not exist"});
    refused({"--materials", good, "--onto", "make:sphere", "--rig", write("rig.json", kRig) + "#3"}, 2, {"#1 to #2"});
    refused({"--materials", good, "--onto", "make:sphere", "--rig", write("bad.json", "{")}, 3, {"bad.json"});
    refused({"--labels", "1=lambert:0.5,7=lambert:1", "--onto", "make:sphere"}, 2, {"no target has a part 7"});
    refused({"--labels", "lambert:0.5", "--onto", "make:sphere"}, 2, {"--labels lambert:0.5", "1=MATERIAL"});
    refused({"--labels", "0=lambert:0.5", "--onto", "make:sphere"}, 2, {"--labels 0=lambert:0.5", "1=MATERIAL"});
    refused({"--onto", "make:sphere"}, 2, {"no material", "--materials"});
    refused({"--materials", good}, 2, {"no target", "--onto"});
    refused({"--materials", good, "--onto", "make:sphere", "--frames", "0"}, 2, {"--frames 0"});
    refused({"--materials", good, "--onto", "make:sphere", "--motion", "sweep"}, 2, {"--motion", "--frames"});
}

TEST_F(LibraryTest, MaterialsAreListedAndBrokenOnesDoNotStopThem)
{
    fs::create_directories(folder_ / "shelf/box");
    saveMaterials("shelf/one.nacre", {"skin"});
    saveMaterials("shelf/box/two.nacre", {"cloth", "leather"});
    saveBrdfTable(folder_ / "shelf/table.exr", frontMaterial("t", glm::vec3(0.2f)).table);
    saveNormalMap(folder_ / "shelf/normals.exr", sphereNormalMap(8));
    write("shelf/broken.binary", "no MERL");
    write("shelf/readme.txt", "no material");
    const ProgramRun run = runNacre({"materials", path("shelf"), "-o", path("balls.png"), "--json", path("list.json")});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_NE(run.out.find("4 usable, 1 not"), std::string::npos) << run.out;
    const auto list = nlohmann::json::parse(readTextFile(folder_ / "list.json")).at("materials");
    ASSERT_EQ(list.size(), 5u) << "neither the normal map nor the text";
    size_t broken = 0;
    for (const auto& item : list) {
        if (item.contains("error")) {
            ++broken;
            EXPECT_NE(item["error"].get<std::string>().find("broken.binary"), std::string::npos);
            continue;
        }
        EXPECT_NO_THROW(loadMaterial(item["material"], {})) << item["material"] << " is what to type";
        EXPECT_GT(item["bytes"].get<size_t>(), 0u);
        EXPECT_GT(item["measured"].get<double>(), 0.9);
    }
    EXPECT_EQ(broken, 1u);
    const Image sheet = loadImage(path("balls.png"));
    EXPECT_GT(*std::max_element(sheet.values.begin(), sheet.values.end()), 0.8f) << "balls are lit";
}

TEST_F(LibraryTest, NothingUsableIsADataError)
{
    write("shelf/broken.binary", "no MERL");
    fs::create_directory(folder_ / "empty");
    expectRefusal(runNacre({"materials", path("shelf"), "-o", path("out.png")}), 3, {"broken.binary", "1 unusable"});
    expectRefusal(runNacre({"materials", path("empty"), "-o", path("out.png")}), 3, {"empty", "no material"});
    expectRefusal(runNacre({"materials", path("shelf"), "-o", path("out.nacre")}), 2, {"out.nacre", ".png"});
    expectRefusal(runNacre({"materials"}), 2, {"--fits DIR"});
}

} // namespace
} // namespace nacre::test
