// A device that is lost in the middle: one line, nothing half-written, nothing left on the device.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/gpu/scenes.h"
#include "tests/support/run_nacre.h"

namespace nacre::test {
namespace {

TEST(LostDevice, IsReportedAndLeavesNothing)
{
    const TempFolder folder;
    saveSurface(folder / "s.nacre", glossyScene(40, 30).surface, false);
    const auto render = [&](const std::string& output, int waits) {
        return runNacre({"render", (folder / "s.nacre").string(), "--light", "0,0,1", "--frames", "3", "-o",
                         (folder / output).string()},
                        "NACRE_VALIDATION=1 LD_PRELOAD='" NACRE_LOST_DEVICE "' NACRE_WAITS_BEFORE_LOSS=" +
                            std::to_string(waits));
    };
    for (const char* output : {"new.webp", "alone.exr"}) {
        ASSERT_EQ(render(output, 1000).exitCode, 0) << "the device that is not lost";
    }
    for (const int waits : {0, 1, 4, 7}) {
        SCOPED_TRACE(waits);
        const ProgramRun run = render("lost.webp", waits);
        EXPECT_EQ(run.exitCode, 3);
        EXPECT_NE(run.err.find("nacre: the Vulkan device was lost: vkWaitForFences answered"), std::string::npos);
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1)
            << "validation names what was not destroyed: " << run.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "lost.webp"));
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
    }
}

} // namespace
} // namespace nacre::test
