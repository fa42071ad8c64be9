// Nobody may learn from a green run that the renderer was not tested: its tests fail where they cannot run.
#include <filesystem>

#include "tests/gpu/gpu_test.h"
#include "tests/support/run_nacre.h"

namespace nacre::test {
namespace {

using GpuSuite = GpuTest;

// This program again, with one of its tests.
ProgramRun runTest(const std::string& name, const std::string& environment)
{
    return runProgram(std::filesystem::read_symlink("/proc/self/exe"), {"--gtest_filter=" + name}, environment);
}

TEST(GpuSuiteAlone, FailsWithoutADevice)
{
    const ProgramRun run =
        runTest("DeviceTest.IsListed", "VK_ICD_FILENAMES=/nonexistent.json VK_DRIVER_FILES=/nonexistent.json");
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_NE(run.out.find("no Vulkan device; install a driver"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("[  FAILED  ] DeviceTest.IsListed"), std::string::npos) << run.out;
}

// Skips itself in a run of its own.
TEST_F(GpuSuite, FailsWhereATestIsSkipped)
{
    if (std::getenv("NACRE_TEST_SKIPS")) {
        GTEST_SKIP();
    }
    const ProgramRun run = runTest("GpuSuite.FailsWhereATestIsSkipped", "NACRE_TEST_SKIPS=1");
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_NE(run.out.find("run or fail"), std::string::npos) << run.out;
}

} // namespace
} // namespace nacre::test
