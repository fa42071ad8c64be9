#include <fstream>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/files/error.h"
#include "engine/files/measures.h"
#include "engine/lights/light_files.h"
#include "engine/surface/surface.h"
#include "tests/support/run_nacre.h"

namespace nacre {
namespace {

// A capture with both spheres, 12 lights, small enough for a moment's work.
class Calibrate : public testing::Test {
protected:
    static void SetUpTestSuite()
    {
        folder_ = new TempFolder;
        const ProgramRun run = runNacre({"synth", path("ball"), "--shape", "sphere", "--side", "48", "--sphere-size",
                                         "128", "--lights", "12", "--noise", "0"});
        ASSERT_EQ(run.exitCode, 0) << run.err;
    }
    static void TearDownTestSuite()
    {
        delete folder_;
        folder_ = nullptr;
    }
    static std::string path(const std::string& name) { return (*folder_ / name).string(); }

    static TempFolder* folder_;
};

TempFolder* Calibrate::folder_ = nullptr;

TEST_F(Calibrate, WritesARigThatAcquireReadsBack)
{
    const ProgramRun written = runNacre({"calibrate", path("ball"), "-o", path("rig.json")});
    ASSERT_EQ(written.exitCode, 0) << written.err;
    EXPECT_NE(written.out.find("polar"), std::string::npos) << written.out;
    EXPECT_NE(written.out.find("shading off by"), std::string::npos);
    const LightFile rig = loadLightFile(path("rig.json"));
    ASSERT_EQ(rig.lights.size(), 12u);
    EXPECT_TRUE(rig.irradianceGiven);

    const ProgramRun acquired = runNacre({"acquire", path("ball"), "--rig", path("rig.json"), "--normals", "threshold",
                                          "-o", path("ball.nacre"), "--compare-rig", path("rig.json")});
    ASSERT_EQ(acquired.exitCode, 0) << acquired.err;
    EXPECT_NE(acquired.out.find("rig.json, matched to the photographs by name"), std::string::npos) << acquired.out;
    EXPECT_NE(acquired.out.find("0.00 degrees in the mean, 0.00 at most"), std::string::npos);
    const Surface surface = loadSurface(path("ball.nacre"));
    ASSERT_EQ(surface.lights.size(), 12u);
    for (size_t i = 0; i < 12; ++i) {
        // The numbers pass through decimal text twice, to the nearest float.
        EXPECT_LT(glm::distance(surface.lights[i].light.direction, rig.lights[i].direction), 1e-6f);
        EXPECT_LT(glm::distance(surface.lights[i].light.irradiance, rig.lights[i].irradiance), 1e-5f);
    }
}

TEST_F(Calibrate, WritesDirectionsAloneAsLpAndSaysSo)
{
    ASSERT_EQ(runNacre({"calibrate", path("ball"), "-o", path("first.json"), "--quiet"}).exitCode, 0);
    const ProgramRun run =
        runNacre({"calibrate", path("ball"), "-o", path("rig.lp"), "--compare-rig", path("first.json")});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_NE(run.out.find("directions alone"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("0.00 degrees in the mean"), std::string::npos) << run.out;
    const LightFile json = loadLightFile(path("first.json")), lp = loadLightFile(path("rig.lp"));
    EXPECT_EQ(lp.photographs, json.photographs);
    for (size_t i = 0; i < lp.lights.size(); ++i) {
        EXPECT_LT(degreesBetween(lp.lights[i].direction, json.lights[i].direction), 1e-3); // seven decimals
    }
}

TEST_F(Calibrate, SkippedPhotographsAreNotInTheRig)
{
    const std::string name = loadLightFile([] {
                                 EXPECT_EQ(runNacre({"calibrate", path("ball"), "-o", path("all.json")}).exitCode, 0);
                                 return path("all.json");
                             }())
                                 .photographs[2];
    const ProgramRun run = runNacre({"calibrate", path("ball"), "-o", path("some.json"), "--skip", name});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_NE(run.out.find("skipped      " + name), std::string::npos) << run.out;
    EXPECT_EQ(loadLightFile(path("some.json")).lights.size(), 11u);
}

TEST_F(Calibrate, RefusesWithTheRightCode)
{
    const auto exitCode = [](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"calibrate", path("ball")});
        return runNacre(arguments).exitCode;
    };
    std::ofstream(path("there.json")) << "mine";
    EXPECT_EQ(exitCode({"-o", path("there.json")}), Error::kData);
    std::string kept;
    std::ifstream(path("there.json")) >> kept;
    EXPECT_EQ(kept, "mine");
    const ProgramRun quiet = runNacre({"calibrate", path("ball"), "-o", path("there.json"), "--force", "--quiet"});
    EXPECT_EQ(quiet.exitCode, 0) << quiet.err;
    EXPECT_EQ(quiet.out, "");
    EXPECT_EQ(exitCode({"-o", path("rig.txt")}), Error::kUsage);
    EXPECT_EQ(exitCode({"-o", path("a.json"), "--offset", "much"}), Error::kUsage);
    EXPECT_EQ(exitCode({"-o", path("a.json"), "--skip", "nobody"}), Error::kUsage);
    EXPECT_EQ(exitCode({}), Error::kUsage);
}

TEST_F(Calibrate, HelpHasAnExample)
{
    const ProgramRun help = runNacre({"calibrate", "--help"});
    EXPECT_EQ(help.exitCode, 0);
    EXPECT_NE(help.out.find("nacre calibrate gray"), std::string::npos);
}

} // namespace
} // namespace nacre
