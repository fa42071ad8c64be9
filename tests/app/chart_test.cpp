#include <algorithm>
#include <filesystem>
#include <iterator>
#include <regex>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/files/image.h"
#include "engine/files/whole_file.h"
#include "tests/support/small_capture.h"

namespace nacre {
namespace {
namespace fs = std::filesystem;

size_t linesOf(const std::string& text)
{
    return static_cast<size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(ChartCommand, WritesTablesPicturesAndOneReport)
{
    const TempFolder folder;
    const std::string output = (folder / "charts").string();
    std::vector<std::string> arguments = {"chart",
                                          makeSmallCapture(folder),
                                          "-o",
                                          output,
                                          "--methods",
                                          "least-squares,consensus",
                                          "--lights-given",
                                          "all,6",
                                          "--k",
                                          "25",
                                          "--parts",
                                          "normals,brdf"};
    const ProgramRun run = runNacre(arguments);
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_NE(run.err.find("settings left"), std::string::npos) << run.err;
    // Under a heading: two methods with all 12 and with 6 lights; two interpolations, three sizes, three formats.
    EXPECT_EQ(linesOf(readTextFile(folder / "charts" / "normals.csv")), 1u + 4);
    EXPECT_EQ(linesOf(readTextFile(folder / "charts" / "brdf.csv")), 1u + 18);
    EXPECT_NE(readTextFile(folder / "charts" / "report.html").find("</html>"), std::string::npos);
    size_t pictures = 0;
    for (const auto& entry : fs::directory_iterator(folder / "charts")) {
        pictures += entry.path().extension() == ".svg";
    }
    EXPECT_EQ(pictures, 3u);
    EXPECT_EQ(runNacre(arguments).exitCode, 3) << "it exists";
    EXPECT_EQ(runNacre({"chart", (folder / "c").string(), "-o", folder.path().string(), "--force"}).exitCode, 3)
        << "a folder that is not its own";
}

TEST(ChartCommand, LeavesWhatIsFinishedWhenItIsInterrupted)
{
    const TempFolder folder;
    const std::string capture = makeSmallCapture(folder), output = (folder / "charts").string();
    // Both by `timeout`: the signal comes while the many settings are under way, whatever the machine's speed.
    const ProgramRun run = runProgram("/usr/bin/timeout", {"--preserve-status", "-s", "INT", "3", NACRE_EXECUTABLE,
                                                           "chart", capture, "-o", output, "--threads", "1"});
    if (run.exitCode == 0) {
        GTEST_SKIP() << "all settings were finished within three seconds";
    }
    EXPECT_EQ(run.exitCode, 130) << run.err;
    EXPECT_NE(run.err.find("was interrupted"), std::string::npos) << run.err;
    const std::string csv = readTextFile(folder / "charts" / "normals.csv");
    EXPECT_GE(linesOf(csv), 2u) << csv;
    EXPECT_EQ(csv.back(), '\n');
    const std::string html = readTextFile(folder / "charts" / "report.html");
    EXPECT_NE(html.find("Interrupted"), std::string::npos);
    EXPECT_NE(html.find("</html>"), std::string::npos);
}

// The header stays, so that it is found out only when pixels are read.
void cutInHalf(const fs::path& file)
{
    fs::resize_file(file, fs::file_size(file) / 2);
}

TEST(ChartCommand, APhotographThatCannotBeReadCostsNothingThatIsFinished)
{
    const TempFolder folder;
    const std::string good = makeSmallCapture(folder), bad = (folder / "bad").string();
    fs::copy(good, bad, fs::copy_options::recursive);
    cutInHalf(fs::path(bad) / "object_05.png");
    const ProgramRun run = runNacre({"chart", bad, good, "-o", (folder / "charts").string(), "--parts", "normals,brdf",
                                     "--methods", "least-squares", "--lights-given", "all", "--k", "25"});
    EXPECT_EQ(run.exitCode, 3);
    EXPECT_NE(run.err.find("object_05.png"), std::string::npos) << run.err;
    EXPECT_EQ(linesOf(readTextFile(folder / "charts" / "normals.csv")), 1u + 1);
    EXPECT_EQ(linesOf(readTextFile(folder / "charts" / "brdf.csv")), 1u + 18);
    const std::string html = readTextFile(folder / "charts" / "report.html");
    EXPECT_NE(html.find("Ended before its time"), std::string::npos);
    EXPECT_NE(html.find("object_05.png"), std::string::npos);
}

TEST(ChartCommand, DrawsFramesByEveryPath)
{
    const TempFolder folder;
    const ProgramRun run = runNacre({"chart", makeSmallCapture(folder), "-o", (folder / "charts").string(), "--parts",
                                     "rendering", "--frame-lights", "2", "--frame-size", "160x96"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    const std::string csv = readTextFile(folder / "charts" / "rendering.csv");
    EXPECT_GE(linesOf(csv), 1u + 6) << "direct, the measured ball and most of the others, which may be too large";
    EXPECT_NE(csv.find(",direct,0,0,2,"), std::string::npos) << csv;
    EXPECT_NE(csv.find(",ball,64,320,2,"), std::string::npos) << csv;
    const std::regex isDefault(",yes,(yes|no),(yes|no)\n"); // is_default, on_steady_front, on_moved_front
    EXPECT_EQ(std::distance(std::sregex_iterator(csv.begin(), csv.end(), isDefault), std::sregex_iterator()), 1);
    EXPECT_TRUE(fs::exists(folder / "charts" / "sphere-rendering-moved.svg"));
}

TEST(ChartCommand, RefusesWhatItDoesNotKnow)
{
    const TempFolder folder;
    const std::string output = (folder / "charts").string();
    const auto expectRefusal = [&](const std::vector<std::string>& more, int exitCode, const std::string& named) {
        std::vector<std::string> all = {"chart", (folder / "nothing").string(), "-o", output};
        all.insert(all.end(), more.begin(), more.end());
        const ProgramRun run = runNacre(all);
        EXPECT_EQ(run.exitCode, exitCode) << named;
        EXPECT_NE(run.err.find(named), std::string::npos) << run.err;
        EXPECT_FALSE(fs::exists(output));
    };
    expectRefusal({}, 3, "nothing");
    const std::string few = (folder / "few").string();
    ASSERT_EQ(runNacre({"synth", few, "--shape", "sphere", "--side", "16", "--sphere-size", "48", "--lights", "3",
                        "--give-lights"})
                  .exitCode,
              0);
    EXPECT_EQ(runNacre({"chart", few, "-o", output}).exitCode, 3) << "one of three is held out, two are too few";
    expectRefusal({"--methods", "magic"}, 2, "magic");
    expectRefusal({"--parts", "magic"}, 2, "magic");
    expectRefusal({"--lights-given", "2"}, 2, "--lights-given 2");
    expectRefusal({"--k", "0"}, 2, "--k 0");
    expectRefusal({"--k", "513"}, 2, "--k 513");
    expectRefusal({"--frame-lights", "0"}, 2, "--frame-lights 0");
    expectRefusal({"--frame-size", "0x9"}, 2, "--frame-size");
}

TEST(EvaluateCommand, TellsPhotographsNormalsBytesAndShowsTheWorst)
{
    const TempFolder folder;
    const std::string capture = makeSmallCapture(folder), summary = (folder / "e.json").string();
    const std::vector<std::string> arguments = {"evaluate", capture, "--normals", "consensus",
                                                "--json",   summary, "-o",        (folder / "sheet").string()};
    const ProgramRun run = runNacre(arguments);
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_NE(run.out.find("worst        object_"), std::string::npos) << run.out;
    const std::string json = readTextFile(summary);
    for (const char* name : {"photographsGiven", "modelBytes", "secondsBaking", "normalsMeanErrorDegrees",
                             "medianRelativeError", "structuralSimilarity", "worstPhotograph"}) {
        EXPECT_NE(json.find(std::string("\"") + name + "\""), std::string::npos) << name;
    }
    const Image sheet = loadImage(folder / "sheet" / "worst.png");
    EXPECT_GT(sheet.width, 3 * 240) << "three cells side by side";
    EXPECT_EQ(runNacre(arguments).exitCode, 3) << "worst.png exists";
    EXPECT_EQ(runNacre({"evaluate", capture, "--hold-out", "each:7"}).exitCode, 2);
}

// Of eight lights six are given, which are few.
TEST(EvaluateCommand, PassesTheAcquisitionsWarningsOn)
{
    const TempFolder folder;
    const std::string capture = (folder / "few").string(), summary = (folder / "e.json").string();
    ASSERT_EQ(runNacre({"synth", capture, "--shape", "sphere", "--side", "24", "--sphere-size", "48", "--lights", "8",
                        "--give-lights"})
                  .exitCode,
              0);
    const auto codes = [&](const std::string& holdOut) {
        const ProgramRun run = runNacre(
            {"evaluate", capture, "--normals", "consensus", "--hold-out", holdOut, "--json", summary, "--force"});
        EXPECT_EQ(run.exitCode, 0) << run.err;
        std::vector<std::string> warnings;
        const nlohmann::json document = nlohmann::json::parse(readTextFile(summary));
        for (const auto& finding : document["findings"]) {
            if (finding["warning"]) {
                warnings.push_back(finding["code"]);
                EXPECT_NE(run.out.find(finding["text"].get<std::string>()), std::string::npos) << run.out;
            }
        }
        return warnings;
    };
    const std::vector<std::string> few = codes("every:4"), more = codes("every:8");
    EXPECT_EQ(std::count(few.begin(), few.end(), "few-lights"), 1);
    EXPECT_EQ(std::count(more.begin(), more.end(), "few-lights"), 0) << "seven are given";
}

TEST(EvaluateCommand, KeepsTheModelWithinTheBudget)
{
    const TempFolder folder;
    const std::string summary = (folder / "e.json").string();
    const ProgramRun run = runNacre({"evaluate", makeSmallCapture(folder), "--normals", "consensus", "--residual",
                                     "difference", "--budget-bytes", "2KiB", "--json", summary});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_LE(nlohmann::json::parse(readTextFile(summary))["modelBytes"], 2048);
    EXPECT_NE(run.out.find("layer        "), std::string::npos) << run.out;
}

} // namespace
} // namespace nacre
