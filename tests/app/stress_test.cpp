#include <filesystem>

#include <gtest/gtest.h>

#include "engine/files/whole_file.h"
#include "tests/support/run_nacre.h"

namespace nacre {
namespace {

ProgramRun runSmall(const std::string& output, std::vector<std::string> more = {})
{
    std::vector<std::string> arguments = {"stress", "synthetic", "-o",       output,      "--side",
                                          "20",     "--sweep",   "coplanar", "--methods", "least-squares,consensus"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runNacre(arguments);
}

TEST(StressCommand, WritesOneTableWholeAndRefusesToReplaceIt)
{
    const TempFolder folder;
    const std::string output = (folder / "stress").string();
    const ProgramRun run = runSmall(output);
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_NE(run.out.find("breaks at"), std::string::npos) << run.out;
    const std::string csv = readTextFile(folder / "stress" / "stress.csv");
    EXPECT_NE(csv.find("synthetic,coplanar,20,degrees beside one plane,consensus,"), std::string::npos) << csv;

    EXPECT_EQ(runSmall(output).exitCode, 3);
    EXPECT_EQ(runSmall(output, {"--force", "--quiet"}).exitCode, 0);
    const ProgramRun foreign = runSmall(folder.path().string(), {"--force"});
    EXPECT_EQ(foreign.exitCode, 3) << "a folder that is not its own";
    EXPECT_TRUE(std::filesystem::exists(folder / "stress"));
}

TEST(StressCommand, RefusesWhatItDoesNotKnow)
{
    const TempFolder folder;
    const std::string output = (folder / "stress").string();
    const auto expectUsage = [&](const std::vector<std::string>& arguments, const std::string& named) {
        std::vector<std::string> all = {"stress", "synthetic", "-o", output};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const ProgramRun run = runNacre(all);
        EXPECT_EQ(run.exitCode, 2) << named;
        EXPECT_NE(run.err.find(named), std::string::npos) << run.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "stress"));
    };
    expectUsage({"--sweep", "magic"}, "magic");
    expectUsage({"--methods", "magic"}, "magic");
    expectUsage({"--material", "magic:1"}, "magic");
    expectUsage({"--side", "4"}, "--side 4");
    const ProgramRun missing = runNacre({"stress", (folder / "nothing").string(), "-o", output});
    EXPECT_EQ(missing.exitCode, 3);
    EXPECT_NE(missing.err.find("nothing"), std::string::npos) << missing.err;
}

TEST(LightsGiven, AreCountedNamedAndRefused)
{
    const TempFolder folder;
    const std::string capture = (folder / "c").string();
    const ProgramRun made = runNacre({"synth", capture, "--shape", "sphere", "--side", "24", "--sphere-size", "48",
                                      "--lights", "14", "--give-lights"});
    ASSERT_EQ(made.exitCode, 0) << made.err;
    const std::string summary = (folder / "n.json").string();
    const auto normals = [&](const std::string& given) {
        return runNacre({"normals", capture, "-o", (folder / "n.exr").string(), "--force", "--normals", "consensus",
                         "--json", summary, "--lights-given", given});
    };
    const ProgramRun few = normals("6");
    ASSERT_EQ(few.exitCode, 0) << few.err;
    EXPECT_NE(few.out.find("given        6 of 14 photographs"), std::string::npos) << few.out;
    // What is not chosen is not read: it may be damaged behind its header.
    const std::string chosen = readTextFile(summary);
    size_t damaged = 0;
    for (const auto& entry : std::filesystem::directory_iterator(capture)) {
        const std::string name = entry.path().filename().string();
        if (name.rfind("object_", 0) == 0 && chosen.find(name) == std::string::npos) {
            std::filesystem::resize_file(entry.path(), std::filesystem::file_size(entry.path()) / 2);
            ++damaged;
        }
    }
    EXPECT_EQ(damaged, 8u);
    EXPECT_EQ(normals("6").exitCode, 0);
    EXPECT_EQ(normals("14").exitCode, 3);
    for (const char* impossible : {"2", "15", "0", "-3", "six"}) {
        const ProgramRun run = normals(impossible);
        EXPECT_EQ(run.exitCode, 2) << impossible;
        EXPECT_NE(run.err.find("lights"), std::string::npos) << run.err;
    }
}

} // namespace
} // namespace nacre
