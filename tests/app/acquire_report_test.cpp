#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/files/whole_file.h"
#include "tests/support/small_capture.h"

namespace nacre {
namespace {
namespace fs = std::filesystem;

std::vector<std::string> wordsOf(const std::string& text)
{
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

void expectSameFiles(const fs::path& a, const fs::path& b)
{
    size_t files = 0;
    for (const auto& entry : fs::directory_iterator(a)) {
        const fs::path name = entry.path().filename();
        EXPECT_EQ(readWholeFile(a / name, "a file"), readWholeFile(b / name, "the same")) << name;
        ++files;
    }
    EXPECT_GE(files, 4u) << "surface.json, normals, labels, a table";
}

TEST(AcquireBudget, WhatIsKeptIsWhatItsOptionsGiveByHand)
{
    const TempFolder folder;
    const std::string capture = makeSmallCapture(folder), found = (folder / "found.nacre").string(),
                      byHand = (folder / "hand.nacre").string(), summary = (folder / "s.json").string();
    // Whatever is kept, much or little time, the bytes are those of its options.
    for (const char* time : {"1ms", "1.5s"}) {
        const ProgramRun run =
            runNacre({"acquire", capture, "-o", found, "--budget-time", time, "--json", summary, "--force"});
        ASSERT_EQ(run.exitCode, 0) << run.err;
        EXPECT_NE(run.out.find("kept         --normals"), std::string::npos) << run.out;
        const auto budget = nlohmann::json::parse(readTextFile(summary)).at("budget");
        EXPECT_EQ(budget.at("comment").get<std::string>().empty(), !budget.at("tried").empty());
        std::vector<std::string> again = {"acquire", capture, "-o", byHand, "--force"};
        for (const std::string& word : wordsOf(budget.at("kept"))) {
            again.push_back(word);
        }
        ASSERT_EQ(runNacre(again).exitCode, 0);
        expectSameFiles(found, byHand);
    }
}

TEST(AcquireBudget, RefusesWhatItWouldChooseItselfAndTimesThatAreNone)
{
    const TempFolder folder;
    const std::string output = (folder / "s.nacre").string();
    for (const std::vector<std::string>& more : {std::vector<std::string>{"--budget-time", "2s", "--normals", "ransac"},
                                                 {"--budget-time", "2s", "--k", "5"},
                                                 {"--budget-time", "0"},
                                                 {"--budget-time", "2h"},
                                                 {"--budget-time", "-1"}}) {
        std::vector<std::string> all = {"acquire", "nothing", "-o", output};
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_EQ(runNacre(all).exitCode, 2) << more[1];
    }
}

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
    for (const char* some : {"width=device-width", "<h2>Lights</h2>", "<h2>Verdicts</h2>", "<h2>BRDF</h2>", ">taken<",
                             "holds every 7th photograph back", "</html>"}) {
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
