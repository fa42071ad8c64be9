#include <cctype>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/command_texts.h"
#include "app/commands/commands.h"
#include "engine/files/error.h"

namespace {

constexpr int kInternalError = 70; // EX_SOFTWARE of sysexits.h

// CLI11's message as one line of the program's own form, with the command whose help answers it.
nacre::Error usageError(const CLI::App& app, const CLI::ParseError& e)
{
    const auto commands = app.get_subcommands();
    if (commands.empty()) {
        const std::vector<std::string> unknown = app.remaining();
        return {"", unknown.empty() ? "no command is given" : fmt::format("'{}' is no command", unknown.front()),
                "see nacre --help", nacre::Error::kUsage};
    }
    std::string text = e.what();
    const std::string unconverted = "Could not convert: ";
    if (text.rfind(unconverted, 0) == 0) {
        text = fmt::format("'{}' is not understood", text.substr(unconverted.size()));
    } else if (text.size() > 1 && std::islower(static_cast<unsigned char>(text[1]))) {
        text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
    }
    return {"", text, fmt::format("see nacre {} --help", commands.front()->get_name()), nacre::Error::kUsage};
}

// Not in --help: the build makes the files from them that an installation holds.
void addTexts(CLI::App& app)
{
    const auto print = [&app](const char* flag, auto text) {
        app.add_flag_callback(flag,
                              [text] {
                                  std::fputs(text().c_str(), stdout);
                                  throw CLI::Success();
                              })
            ->group("");
    };
    print("--bash-completion", [&app] { return nacre::bashCompletion(app); });
    print("--man-page", [&app] { return nacre::manPage(app, NACRE_VERSION); });
}

// In the order and under the headings of --help.
void addCommands(CLI::App& app)
{
    using Adders = std::vector<void (*)(CLI::App&)>;
    const std::pair<const char*, Adders> groups[] = {
        {"Measure",
         {nacre::addAcquireCommand, nacre::addNormalsCommand, nacre::addCalibrateCommand, nacre::addMaterialsCommand,
          nacre::addBrdfCommand, nacre::addExportCommand}},
        {"Render", {nacre::addRenderCommand, nacre::addTransferCommand, nacre::addTargetCommand}},
        {"Look", {nacre::addViewCommand, nacre::addInfoCommand}},
        {"Judge",
         {nacre::addEvaluateCommand, nacre::addChartCommand, nacre::addStressCommand, nacre::addBenchCommand,
          nacre::addCompareCommand}},
        {"Make", {nacre::addSynthCommand, nacre::addDemoCommand}},
    };
    for (const auto& [heading, adders] : groups) {
        for (const auto add : adders) {
            add(app);
            app.get_subcommands({}).back()->group(heading);
        }
    }
}

int runCommandLine(int argc, char** argv)
{
    CLI::App app("Nacre measures materials from photographs under a moving light and relights them.");
    app.set_version_flag("--version", "nacre " NACRE_VERSION);
    app.require_subcommand(1);
    addTexts(app);
    addCommands(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() != 0) {
            throw usageError(app, e);
        }
        return app.exit(e); // --help and --version
    }
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    try {
        return runCommandLine(argc, argv);
    } catch (const nacre::Error& e) {
        std::fprintf(stderr, "nacre: %s\n", e.what());
        return e.exitCode();
    } catch (const std::filesystem::filesystem_error& e) {
        std::fprintf(stderr, "nacre: %s: %s; a place that may be read and written\n", e.path1().c_str(),
                     e.code().message().c_str());
        return nacre::Error::kData;
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "nacre: not enough memory; fewer or smaller pictures\n");
        return nacre::Error::kData;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "nacre: internal error: %s\n", e.what());
        return kInternalError;
    }
}
