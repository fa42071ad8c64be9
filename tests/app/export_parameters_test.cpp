// nacre export --gltf, --materialx and --balls as their users start them.
#include <gtest/gtest.h>

#include "engine/files/error.h"
#include "engine/files/image.h"
#include "engine/files/whole_file.h"
#include "tests/gpu/scenes.h"
#include "tests/support/expect_one_line.h"
#include "tests/support/run_nacre.h"

namespace nacre::test {
namespace {
namespace fs = std::filesystem;

class ExportParameters : public testing::Test {
protected:
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    TempFolder folder_;
};

constexpr const char* kPlastic = "ggx:diffuse=0.5,0.3,0.2;alpha=0.3";

TEST_F(ExportParameters, AMaterialLeavesAsBothFormatsWithItsError)
{
    const ProgramRun made = runNacre(
        {"export", kPlastic, "--gltf", path("a.glb"), "--materialx", path("a.mtlx"), "--balls", path("a.png")});
    ASSERT_EQ(made.exitCode, 0) << made.err;
    EXPECT_NE(made.out.find("glTF "), std::string::npos) << made.out;
    EXPECT_NE(made.out.find("standard_surface "), std::string::npos) << made.out;
    EXPECT_NE(made.out.find(" dB on the covered part"), std::string::npos) << made.out;
    EXPECT_EQ(readWholeFile(path("a.glb"), "").substr(0, 4), "glTF");
    EXPECT_NE(readTextFile(path("a.mtlx")).find("<standard_surface "), std::string::npos);
    EXPECT_EQ(readImageHeader(path("a.png")).width, 720); // measured, glTF, MaterialX
    expectOneLine(runNacre({"export", kPlastic, "--gltf", path("a.glb")}), Error::kData, {"a.glb", "--force"});
}

TEST_F(ExportParameters, ASurfaceLeavesAsARelief)
{
    saveSurface(folder_ / "a.nacre", glossyScene(48, 40).surface, false);
    const ProgramRun made = runNacre({"export", path("a.nacre"), "--gltf", path("a.glb"), "--width", "0.2"});
    ASSERT_EQ(made.exitCode, 0) << made.err;
    EXPECT_NE(made.out.find("0.2 m wide"), std::string::npos) << made.out;
    EXPECT_NE(made.out.find("its pictures have "), std::string::npos) << made.out;
}

TEST_F(ExportParameters, RefusesWithTheRightCode)
{
    Surface target = glossyScene(24, 20).surface;
    target.materials.clear();
    target.parts = {"a", "b", "c", "d"};
    saveSurface(folder_ / "target.nacre", target, false);
    expectOneLine(runNacre({"export", path("target.nacre"), "--gltf", path("a.glb")}), Error::kData,
                  {"target.nacre", "without a material"});
    expectOneLine(runNacre({"export", kPlastic, "--gltf", path("a.gltf")}), Error::kUsage, {"NAME.glb"});
    expectOneLine(runNacre({"export", kPlastic, "--gltf", path("a.glb"), "--width", "0"}), Error::kUsage, {"--width"});
    expectOneLine(runNacre({"export", kPlastic, "--gltf", path("none/a.glb")}), Error::kData, {"none"});
    expectOneLine(runNacre({"export", "lambert:0", "--materialx", path("a.mtlx")}), Error::kData,
                  {"no parameters", "lambert:0"});
    EXPECT_FALSE(fs::exists(path("a.glb")) || fs::exists(path("a.mtlx")));
}

} // namespace
} // namespace nacre::test
