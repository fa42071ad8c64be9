// nacre export as its users start it.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/files/error.h"
#include "engine/files/measures.h"
#include "engine/files/whole_file.h"
#include "engine/rti/ptm_file.h"
#include "engine/rti/rti_web.h"
#include "engine/target/mesh_file.h"
#include "tests/gpu/scenes.h"
#include "tests/support/expect_one_line.h"
#include "tests/support/run_nacre.h"

namespace nacre::test {
namespace {
namespace fs = std::filesystem;

class Export : public testing::Test {
protected:
    Export()
    {
        surface_ = glossyScene(48, 40).surface;
        saveSurface(folder_ / "a.nacre", surface_, false);
    }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    ProgramRun run(std::vector<std::string> more)
    {
        std::vector<std::string> arguments = {"export", path("a.nacre")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runNacre(arguments);
    }
    // Nothing but the surface and what is named.
    void expectFolderHolds(std::vector<std::string> names)
    {
        names.push_back("a.nacre");
        std::vector<std::string> found;
        for (const auto& entry : fs::directory_iterator(folder_.path())) {
            found.push_back(entry.path().filename().string());
        }
        std::sort(names.begin(), names.end());
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, names);
    }
    double psnrPrinted(const std::string& out, const std::string& name)
    {
        const size_t line = out.find(path(name));
        const size_t end = line == out.npos ? out.npos : out.find(" dB against the surface", line);
        if (end == out.npos) {
            ADD_FAILURE() << name << " has no PSNR in: " << out;
            return 0;
        }
        return std::stod(out.substr(out.rfind(' ', end - 1)));
    }

    TempFolder folder_;
    Surface surface_;
};

// A ball bulges, and heights that are off by a factor or a sign do not.
TEST_F(Export, HeightIsThatOfTheNormals)
{
    ASSERT_EQ(run({"--height", path("h.exr")}).exitCode, 0);
    const Image height = loadImage(folder_ / "h.exr");
    const NormalMap& map = surface_.normals;
    ASSERT_EQ(height.width, map.width);
    double error = 0, steps = 0;
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x + 1 < map.width; ++x) {
            const glm::vec3 a = map.normals[map.index(x, y)], b = map.normals[map.index(x + 1, y)];
            if (a.z > 0.7f && b.z > 0.7f) { // steeper, a pixel's step is no slope
                const float slope = -(a.x / a.z + b.x / b.z) / 2;
                error += std::abs(height.at(x + 1, y) - height.at(x, y) - slope);
                ++steps;
            }
        }
    }
    ASSERT_GT(steps, 100);
    EXPECT_LT(error / steps, 0.05); // of slopes up to 1
}

// Our own reader finds each pixel's place, height and normal in all three formats.
TEST_F(Export, AMeshIsTheReliefInMetres)
{
    ASSERT_EQ(run({"--height", path("h.exr")}).exitCode, 0);
    const Image height = loadImage(folder_ / "h.exr");
    const NormalMap& map = surface_.normals;
    constexpr double kMetres = 0.24 / 48; // a pixel
    for (const std::string name : {"m.ply", "m.obj", "m.glb"}) {
        const ProgramRun made = run({"--mesh", path(name), "--width", "0.24"});
        ASSERT_EQ(made.exitCode, 0) << made.err;
        const Mesh mesh = loadMesh(path(name));
        EXPECT_FALSE(mesh.normalsWereMade) << name;
        ASSERT_GT(mesh.triangleCount(), 1000u) << name;
        std::vector<double> offset; // the height is known up to a constant
        for (size_t i = 0; i < mesh.positions.size(); ++i) {
            const glm::dvec3 p = glm::dvec3(mesh.positions[i]) / kMetres;
            const double column = p.x + 24 - 0.5, row = 20 - p.y - 0.5;
            const int x = static_cast<int>(std::lround(column)), y = static_cast<int>(std::lround(row));
            ASSERT_NEAR(column, x, 1e-3) << name;
            ASSERT_NEAR(row, y, 1e-3) << name;
            ASSERT_GT(map.confidence[map.index(x, y)], 0) << name;
            offset.push_back(p.z - height.at(x, y));
            ASSERT_NEAR(offset.back(), offset.front(), 1e-3) << name;
            ASSERT_LT(degreesBetween(mesh.normals[i], map.normals[map.index(x, y)]), 0.05) << name;
            if (mesh.uvs.empty()) {
                continue; // a .glb without textures
            }
            ASSERT_NEAR(mesh.uvs[i].x, (x + 0.5) / 48, 1e-4) << name;
            ASSERT_NEAR(mesh.uvs[i].y, 1 - (y + 0.5) / 40, 1e-4) << name;
        }
        double facing = 0; // counter-clockwise from the camera
        for (size_t i = 0; i < mesh.indices.size(); i += 3) {
            const glm::vec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]],
                            c = mesh.positions[mesh.indices[i + 2]];
            facing += glm::cross(b - a, c - a).z > 0 ? 1 : -1;
        }
        EXPECT_EQ(facing, static_cast<double>(mesh.triangleCount())) << name;
    }
    expectOneLine(run({"--mesh", path("m.stl")}), 2, {"--mesh", ".ply", ".glb"});
}

TEST_F(Export, FilesOpenAndShowTheSurface)
{
    const ProgramRun made = run({"--ptm", path("a.ptm"), "--rti-web", path("web"), "--lights", "40"});
    ASSERT_EQ(made.exitCode, 0) << made.err;
    expectFolderHolds({"a.ptm", "web"});
    const PtmFile ptm = loadPtm(path("a.ptm"));
    EXPECT_EQ(ptm.width, 48);
    EXPECT_EQ(ptm.height, 40);
    EXPECT_EQ(ptm.format, PtmFormat::lrgb);
    EXPECT_EQ(loadRtiWeb(path("web")).basis, RtiBasis::hsh);
    // A narrow highlight is out of reach of six and nine terms, the diffuse part and the shading are not: black
    // pictures would have 10 dB, upside-down ones about as much.
    EXPECT_GT(psnrPrinted(made.out, "a.ptm"), 18);
    EXPECT_GT(psnrPrinted(made.out, "web"), 18);
    EXPECT_NE(made.out.find("fitted to 40 lights"), std::string::npos) << made.out;
}

TEST_F(Export, ABiquadraticAChannelIsNearerThanOneForAll)
{
    const ProgramRun one = run({"--ptm", path("one.ptm"), "--exposure", "0"});
    const ProgramRun three = run({"--ptm", path("three.ptm"), "--ptm-format", "rgb", "--exposure", "0"});
    ASSERT_EQ(three.exitCode, 0) << three.err;
    EXPECT_EQ(loadPtm(path("three.ptm")).format, PtmFormat::rgb);
    EXPECT_GT(psnrPrinted(three.out, "three.ptm"), psnrPrinted(one.out, "one.ptm"));
}

TEST_F(Export, SameBytesForAnyNumberOfThreads)
{
    for (const std::string threads : {"1", "3"}) {
        const ProgramRun made = run({"--ptm", path(threads + ".ptm"), "--rti-web", path("web" + threads), "--lights",
                                     "18", "--threads", threads, "--quiet"});
        ASSERT_EQ(made.exitCode, 0) << made.err;
        EXPECT_EQ(made.out, "");
    }
    EXPECT_EQ(readWholeFile(path("1.ptm"), ""), readWholeFile(path("3.ptm"), ""));
    EXPECT_EQ(readWholeFile(path("web1/plane_4.jpg"), ""), readWholeFile(path("web3/plane_4.jpg"), ""));
}

// A 16-bit step is 2 / 65535 a component: 0.003 degrees with all three off by half of one.
TEST_F(Export, NormalsComeBackThroughTarget)
{
    ASSERT_EQ(run({"--write-normals", path("n.png")}).exitCode, 0);
    ASSERT_EQ(run({"--write-normals", path("n.exr"), "--quiet"}).exitCode, 0);
    EXPECT_EQ(readImageHeader(path("n.png")).pixelType, "uint16");
    for (const auto& [file, tolerance] : {std::pair("n.png", 0.003), std::pair("n.exr", 1e-4)}) {
        const std::string target = path(std::string(file) + ".nacre");
        const ProgramRun taken = runNacre({"target", path(file), "-o", target});
        ASSERT_EQ(taken.exitCode, 0) << taken.err;
        const NormalMap normals = loadSurface(target).normals;
        ASSERT_EQ(normals.normals.size(), surface_.normals.normals.size());
        double largest = 0;
        for (size_t i = 0; i < normals.normals.size(); ++i) {
            ASSERT_EQ(normals.confidence[i] > 0, surface_.normals.confidence[i] > 0);
            if (normals.confidence[i] > 0) {
                largest = std::max(largest, degreesBetween(normals.normals[i], surface_.normals.normals[i]));
            }
        }
        EXPECT_LT(largest, tolerance) << file;
    }
}

TEST_F(Export, AlbedoIsTheReflectanceFactorAt45Degrees)
{
    surface_.materials = {
        materialOf(LambertGgx{{0.5f, 0.4f, 3.0f}, glm::vec3(0), 0.3f}, {kHalfDifference, kHalfPi}, {8, 8, 8})};
    surface_.albedo = Image(48, 40, 3, 1.5f);
    saveSurface(folder_ / "a.nacre", surface_, true);
    ASSERT_EQ(run({"--albedo", path("a.exr")}).exitCode, 0);
    const ProgramRun made = run({"--albedo", path("a.png")});
    ASSERT_EQ(made.exitCode, 0) << made.err;
    EXPECT_NE(made.out.find("divided by 8"), std::string::npos) << made.out;
    EXPECT_EQ(readImageAttribute(path("a.png"), "nacre:albedoScale"), "8");
    const Image floats = loadImage(path("a.exr")), coded = loadImage(path("a.png"));
    for (size_t i = 0; i < surface_.labels.size(); ++i) {
        const bool seen = surface_.normals.confidence[i] > 0;
        EXPECT_NEAR(floats.values[3 * i], seen ? 0.75 : 0, 1e-4);
        EXPECT_NEAR(8 * coded.values[3 * i + 2], seen ? 4.5 : 0, 8.0 / 65535 + 1e-4);
    }
}

TEST_F(Export, SizesAreFittedAndInfoDescribesTheFile)
{
    ASSERT_EQ(run({"--ptm", path("a.ptm"), "--size", "24x20", "--lights", "18"}).exitCode, 0);
    const ProgramRun info = runNacre({"info", path("a.ptm")});
    EXPECT_EQ(info.exitCode, 0) << info.err;
    EXPECT_NE(info.out.find("PTM_FORMAT_LRGB, 24x20"), std::string::npos) << info.out;
    writeText(folder_ / "cut.ptm", readWholeFile(path("a.ptm"), "").substr(0, 200));
    expectOneLine(runNacre({"info", path("cut.ptm")}), Error::kData, {"cut.ptm", "bytes after its header"});
}

TEST_F(Export, RefusesWithTheRightCode)
{
    expectOneLine(run({}), Error::kUsage, {"nothing is asked for"});
    expectOneLine(run({"--ptm", path("a.png")}), Error::kUsage, {"--ptm", "NAME.ptm"});
    expectOneLine(run({"--write-normals", path("a.jpg")}), Error::kUsage, {"--write-normals", ".png or NAME.exr"});
    expectOneLine(run({"--ptm", path("a.ptm"), "--ptm-format", "lum"}), Error::kUsage, {"lum", "lrgb or rgb"});
    expectOneLine(run({"--rti-web", path("w"), "--basis", "rbf"}), Error::kUsage, {"rbf"});
    expectOneLine(run({"--ptm", path("a.ptm"), "--lights", "6"}), Error::kUsage, {"--lights 6"});
    expectOneLine(run({"--ptm", path("a.ptm"), "--exposure", "inf"}), Error::kUsage, {"--exposure"});
    expectOneLine(run({"--write-normals", path("a.exr"), "--albedo", path("a.exr")}), Error::kUsage, {"twice"});
    expectOneLine(run({"--ptm", path("a.ptm"), "--size", "24"}), Error::kUsage, {"--size 24"});
    expectOneLine(run({"--write-normals", path("a.nacre/normals.exr")}), Error::kData, {"exists already"});
    expectOneLine(run({"--write-normals", path("a.nacre/normals.exr"), "--force"}), Error::kData,
                  {"lies in a surface"});
    expectOneLine(run({"--ptm", path("none/a.ptm")}), Error::kData, {"folder does not exist"});
    expectOneLine(runNacre({"export", path("no.nacre"), "--ptm", path("a.ptm")}), Error::kData, {"no.nacre"});
    expectFolderHolds({});
}

TEST_F(Export, ReplacesWithForceAloneAndNothingOfOthers)
{
    writeText(folder_ / "a.ptm", "mine");
    expectOneLine(run({"--ptm", path("a.ptm"), "--lights", "18"}), Error::kData, {"exists already"});
    EXPECT_EQ(readTextFile(path("a.ptm")), "mine");
    EXPECT_EQ(run({"--ptm", path("a.ptm"), "--lights", "18", "--force"}).exitCode, 0);
    writeText(folder_ / "web/diary.txt", "mine");
    expectOneLine(run({"--rti-web", path("web"), "--lights", "18", "--force"}), Error::kData, {"holds no info.json"});
    EXPECT_EQ(readTextFile(path("web/diary.txt")), "mine");
    expectFolderHolds({"a.ptm", "web"});
}

TEST_F(Export, TargetsHaveNormalsAlone)
{
    ASSERT_EQ(runNacre({"target", "make:head", "--size", "40x40", "-o", path("t.nacre")}).exitCode, 0);
    EXPECT_EQ(runNacre({"export", path("t.nacre"), "--write-normals", path("t.png")}).exitCode, 0);
    expectOneLine(runNacre({"export", path("t.nacre"), "--ptm", path("t.ptm")}), Error::kData,
                  {"t.nacre", "without a material"});
    EXPECT_EQ(runNacre({"export", "--help"}).out.find("nacre export horse.nacre") == std::string::npos, false);
}

} // namespace
} // namespace nacre::test
