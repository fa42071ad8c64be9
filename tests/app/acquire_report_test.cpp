#include <filesystem>

#include <gtest/gtest.h>

#include "engine/files/whole_file.h"
#include "tests/support/small_capture.h"

namespace nacre {
namespace {
namespace fs = std::filesystem;

TEST(AcquireReport, IsOnePageThatStandsAlone)
{
    const TempFolder folder;
    const std::string capture = makeSmallCapture(folder), report = (folder / "deep" / "report").string();
    const std::vector<std::string> arguments = {"acquire",   capture,       "-o",       (folder / "s.nacre").string(),
                                                "--normals", "consensus",   "--report", report,
                                                "--force",   "--tolerance", "40dB"};
    const ProgramRun run = runNacre(arguments);
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const std::string html = readTextFile(fs::path(report) / "report.html");
    EXPECT_EQ(std::distance(fs::directory_iterator(report), {}), 1) << "one page and nothing else";
    size_t pictures = 0;
    for (size_t at = 0; (at = html.find("<img src=\"", at)) != std::string::npos; at += 10) {
        EXPECT_EQ(html.compare(at + 10, 11, "data:image/"), 0);
        ++pictures;
    }
    EXPECT_EQ(pictures, 14u + 3) << "every photograph, normals, confidence, the ball";
    for (const char* none : {"href=", "<script", "<iframe", "url("}) {
        EXPECT_EQ(html.find(none), std::string::npos) << none;
    }
    for (const char* some : {"width=device-width", "<h2>Shadows and highlights found</h2>",
                             "<h2>Reflectance (BRDF)</h2>", ">taken<", "holds every 7th photograph back", "</html>"}) {
        EXPECT_NE(html.find(some), std::string::npos) << some;
    }
    std::vector<std::string> again = arguments;
    std::erase(again, "--force");
    again[3] = (folder / "other.nacre").string();
    EXPECT_EQ(runNacre(again).exitCode, 3) << "it exists";
    EXPECT_FALSE(fs::exists(folder / "other.nacre")) << "which is said before the work";
}

} // namespace
} // namespace nacre
