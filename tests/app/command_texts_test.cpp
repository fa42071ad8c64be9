// What an installation tells shells and man(1).
#include <gtest/gtest.h>

#include "tests/support/run_nacre.h"

namespace nacre {
namespace {

TEST(CommandTexts, CompletionKnowsCommandsAndTheirOptions)
{
    const TempFolder folder;
    writeText(folder / "nacre", runNacre({"--bash-completion"}).out);
    writeText(folder / "try", "source \"$(dirname \"$0\")/nacre\"\n"
                              "COMP_WORDS=(nacre calib) COMP_CWORD=1\n_nacre\necho \"${COMPREPLY[@]}\"\n"
                              "COMP_WORDS=(nacre calibrate --mirr) COMP_CWORD=2\n_nacre\necho \"${COMPREPLY[@]}\"\n");
    const ProgramRun run = runProgram("/bin/bash", {(folder / "try").string()});
    EXPECT_EQ(run.out, "calibrate\n--mirror-sphere\n") << run.err;
}

TEST(CommandTexts, ManualPageHasEveryCommand)
{
    const std::string page = runNacre({"--man-page"}).out;
    EXPECT_EQ(page.rfind(".TH NACRE 1 ", 0), 0u);
    for (const char* heading : {".SH NACRE ACQUIRE\n", ".SH NACRE RENDER\n", ".SH EXIT STATUS\n"}) {
        EXPECT_NE(page.find(heading), std::string::npos) << heading;
    }
    EXPECT_NE(page.find("\\fB\\-o, \\-\\-output\\fR \\fI"), std::string::npos);
}

} // namespace
} // namespace nacre
