// nacre import as its users start it.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/files/measures.h"
#include "engine/files/whole_file.h"
#include "engine/rti/rti_web.h"
#include "tests/gpu/scenes.h"
#include "tests/support/expect_one_line.h"
#include "tests/support/hsh_file.h"
#include "tests/support/run_nacre.h"

namespace nacre::test {
namespace {

class Import : public testing::Test {
protected:
    Import()
    {
        surface_ = glossyScene(48, 40).surface;
        // Matt: six and nine smooth terms hold its shading, not a highlight.
        surface_.materials = {
            materialOf(LambertGgx{{0.5f, 0.4f, 0.3f}, glm::vec3(0), 0.3f}, {kHalfDifference, kHalfPi}, {8, 8, 8})};
        saveSurface(folder_ / "a.nacre", surface_, false);
    }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    // Mean angle between imported normals and those of the surface, where these face the camera.
    double errorOf(const std::string& name)
    {
        const Surface imported = loadSurface(path(name));
        EXPECT_EQ(imported.normals.width, 48);
        double sum = 0, count = 0;
        for (size_t i = 0; i < surface_.normals.normals.size(); ++i) {
            if (surface_.normals.confidence[i] > 0 && surface_.normals.normals[i].z > 0.5f &&
                imported.normals.confidence[i] > 0) {
                sum += degreesBetween(surface_.normals.normals[i], imported.normals.normals[i]);
                ++count;
            }
        }
        EXPECT_GT(count, 300);
        return sum / count;
    }

    TempFolder folder_;
    Surface surface_;
};

TEST_F(Import, NormalsOfAMattBallComeBackFromEveryKind)
{
    ASSERT_EQ(runNacre({"export", path("a.nacre"), "--ptm", path("a.ptm"), "--rti-web", path("web")}).exitCode, 0);
    writeTextFile(folder_ / "a.rti", hshBytes(loadRtiWeb(folder_ / "web")));
    for (const std::string& source : {path("a.ptm"), path("web"), path("a.rti")}) {
        const ProgramRun run = runNacre({"import", source, "-o", path("b.nacre"), "--force"});
        ASSERT_EQ(run.exitCode, 0) << source << run.err;
        EXPECT_LT(errorOf("b.nacre"), 10) << source; // sRGB codes of shading are no polynomial of the second degree
        EXPECT_NE(run.out.find("not held"), std::string::npos) << run.out;
    }
}

TEST_F(Import, WhatIsNoSuchFileIsRefused)
{
    writeTextFile(folder_ / "x.rti", "#HSH1.2\n4\n2 2 3\n9 2 1\n");
    writeTextFile(folder_ / "y.rti", "#HSH1.2\n3\n2 2 3\n9 2 1\n");
    writeTextFile(folder_ / "z.rti", "#HSH1.2\n3\n2 2 3\n16 2 1\n");
    const auto refuse = [&](const std::string& source, int code, std::vector<std::string> parts) {
        expectOneLine(runNacre({"import", source, "-o", path("c.nacre")}), code, parts);
        EXPECT_FALSE(std::filesystem::exists(folder_ / "c.nacre"));
    };
    refuse(path("x.rti"), 3, {"x.rti", "another kind"});
    refuse(path("y.rti"), 3, {"y.rti", "0 bytes", "180"});
    refuse(path("z.rti"), 3, {"z.rti", "16 terms"});
    refuse(path("none.ptm"), 3, {"none.ptm", "does not exist"});
    expectOneLine(runNacre({"import", path("x.rti"), "-o", path("c")}), 2, {"NAME.nacre"});
    expectOneLine(runNacre({"import", path("x.rti"), "-o", path("c.nacre"), "--lights", "3"}), 2, {"--lights 3"});
}

} // namespace
} // namespace nacre::test
