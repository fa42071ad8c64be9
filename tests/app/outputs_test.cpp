// Nothing of a user's is lost, whatever command and output: made from the tree of commands, where outputs are the
// options whose text begins with OUT.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <map>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "app/commands/commands.h"
#include "engine/files/image.h"
#include "tests/support/expect_error.h"
#include "tests/support/expect_one_line.h"
#include "tests/support/run_nacre.h"

namespace nacre {
namespace {
namespace fs = std::filesystem;

constexpr const char* kPrecious = "precious";

struct Output {
    const CLI::App* command;
    const CLI::Option* option;
    std::string extension; // empty: a folder
};

std::string formOf(const CLI::Option& option)
{
    return option.get_positional() ? option.get_name(true) : option.get_option_text();
}

std::vector<Output> outputsOf(const CLI::App& app)
{
    std::vector<Output> outputs;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        for (const CLI::Option* option : command->get_options()) {
            const std::string form = formOf(*option);
            if (form.rfind("OUT", 0) == 0) {
                const std::string first = form.substr(3, form.find('|') - 3);
                outputs.push_back({command, option, first == ".nacre" ? "" : first});
            }
        }
    }
    return outputs;
}

fs::path placeOf(const Output& output)
{
    return fs::path("out").concat(output.extension.empty() ? ".nacre" : output.extension);
}

// The command with that output and nothing else that is there.
std::vector<std::string> argumentsFor(const Output& output, const fs::path& place, const TempFolder& folder)
{
    std::vector<std::string> arguments = {output.command->get_name()};
    for (const CLI::Option* option : output.command->get_options()) {
        const bool isTransfer = output.command->get_name() == "transfer"; // needs a shape
        const bool isNeeded =
            option->get_positional() || option->get_required() || (isTransfer && option->check_name("--onto"));
        if (!isNeeded && option != output.option) {
            continue;
        }
        if (!option->get_positional()) {
            arguments.push_back("--" + option->get_lnames().front());
        }
        const std::string form = formOf(*option);
        const bool isOutput = form.rfind("OUT", 0) == 0;
        const std::string other = isOutput ? form.substr(0, form.find('|')) : "";
        arguments.push_back((option == output.option ? place : folder / (isOutput ? other : "missing")).string());
    }
    if (output.command->get_option_no_throw("--headless")) {
        arguments.push_back("--headless");
    }
    return arguments;
}

// Names and contents of all that is in a folder.
std::map<fs::path, std::string> contentsOf(const fs::path& folder)
{
    std::map<fs::path, std::string> contents;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        std::stringstream text;
        text << (entry.is_symlink() ? "-> " + fs::read_symlink(entry).string() : "");
        if (entry.is_regular_file()) {
            text << std::ifstream(entry.path()).rdbuf();
        }
        contents[entry.path()] = text.str();
    }
    return contents;
}

class Outputs : public testing::Test {
protected:
    void SetUp() override { addCommands(app_); }

    // What stands there already, as the user sees it: a file, or a folder of files.
    static void put(const fs::path& place, bool isFolder)
    {
        if (isFolder) {
            fs::create_directory(place);
        }
        writeText(isFolder ? place / "photograph.png" : place, kPrecious);
    }

    // In this process, as a start costs more than a refusal. Whatever is refused is refused before the work.
    void expectKept(const Output& output, const fs::path& place, const std::string& fragment, bool force = false)
    {
        SCOPED_TRACE(output.command->get_name() + " " + output.option->get_name());
        std::vector<std::string> arguments = argumentsFor(output, place, folder_);
        if (force) {
            arguments.push_back("--force");
        }
        std::reverse(arguments.begin(), arguments.end()); // as CLI11 takes them
        const auto before = contentsOf(folder_.path());
        CLI::App app;
        addCommands(app);
        expectError([&] { app.parse(arguments); }, {place.filename().string(), fragment});
        EXPECT_EQ(contentsOf(folder_.path()), before);
    }

    CLI::App app_;
    TempFolder folder_;
};

TEST_F(Outputs, ThatExistAreKept)
{
    const std::vector<Output> outputs = outputsOf(app_);
    EXPECT_GT(outputs.size(), 25u);
    for (const Output& output : outputs) {
        const fs::path place = folder_ / placeOf(output);
        put(place, output.extension.empty());
        expectKept(output, place, "exists already");
        fs::remove_all(place);
        put(folder_ / "target", output.extension.empty());
        fs::create_symlink("target", place);
        expectKept(output, place, "exists already");
        fs::remove_all(place);
        fs::remove_all(folder_ / "target");
    }
}

TEST_F(Outputs, OfAnotherKindAreKeptWhateverIsForced)
{
    for (const Output& output : outputsOf(app_)) {
        const bool isFolder = output.extension.empty();
        const fs::path place = folder_ / placeOf(output);
        put(place, !isFolder);
        expectKept(output, place, isFolder ? "is no folder" : "is a folder", true);
        fs::remove_all(place);
    }
}

TEST_F(Outputs, ForceReplacesNoFolderOfSomethingElse)
{
    put(folder_ / "out.nacre", true);
    for (const Output& output : outputsOf(app_)) {
        const std::string command = output.command->get_name();
        const bool isWhole = output.option->get_positional() || output.option->check_name("--rti-web") ||
                             (output.option->check_name("-o") && command != "evaluate" && command != "brdf");
        if (output.extension.empty() && isWhole) {
            expectKept(output, folder_ / "out.nacre", "holds no", true);
        }
    }
}

TEST(StandardOutput, HasTheSummaryAlone)
{
    const TempFolder folder;
    const std::string picture = folder / "a.exr";
    saveImage(picture, Image(4, 4, 3, 0.5f), PixelType::float32);
    for (const char* name : {"-", "/dev/stdout"}) {
        const ProgramRun run = runNacre({"compare", picture, picture, "--json", name});
        EXPECT_EQ(run.exitCode, 0) << run.err;
        EXPECT_EQ(run.out.front(), '{');
        EXPECT_EQ(run.out.substr(run.out.size() - 2), "}\n");
        EXPECT_NE(run.err.find("PSNR"), std::string::npos);
    }
}

TEST(StandardOutput, ThatIsFullIsAnError)
{
    const ProgramRun run = runProgram("/bin/sh", {"-c", std::string(NACRE_EXECUTABLE) + " --help > /dev/full"});
    expectOneLine(run, 3, {"standard output", "No space left"});
    const TempFolder folder;
    const std::string picture = (folder / "a.png").string();
    saveImage(picture, Image(8, 8, 3, 0.5f), PixelType::uint8);
    const ProgramRun summary = runProgram(
        "/bin/sh", {"-c", fmt::format("{0} compare {1} {1} --json - > /dev/full", NACRE_EXECUTABLE, picture)});
    EXPECT_EQ(summary.exitCode, 3);
    EXPECT_NE(summary.err.find("standard output: cannot be written"), std::string::npos) << summary.err;
}

bool holdsPart(const fs::path& folder)
{
    const fs::directory_iterator entries(folder);
    return std::any_of(begin(entries), end(entries), [](const fs::directory_entry& entry) {
        return entry.path().native().find(".part") != std::string::npos && !fs::is_empty(entry);
    });
}

TEST(Signals, LeaveNoPartsBehind)
{
    const TempFolder folder;
    const std::string out = folder / "c";
    const pid_t child = fork();
    if (child == 0) {
        execl(NACRE_EXECUTABLE, "nacre", "synth", out.c_str(), "--side", "512", "--quiet", nullptr);
        _exit(127);
    }
    int status = 0;
    while (!holdsPart(folder.path()) && waitpid(child, &status, WNOHANG) == 0) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    kill(child, SIGTERM);
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM) << status;
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

} // namespace
} // namespace nacre
