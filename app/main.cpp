#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/arguments/nearest_name.h"
#include "app/commands/commands.h"
#include "engine/files/error.h"
#include "engine/files/unfinished.h"

namespace nacre {
namespace {

std::vector<const CLI::App*> commandsOf(const CLI::App& app)
{
    return app.get_subcommands([](const CLI::App* command) { return !command->get_name().empty(); });
}

// Without those that --help hides.
std::vector<const CLI::Option*> shownOptions(const CLI::App& app)
{
    return app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

std::vector<std::string> longNames(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::Option* option : shownOptions(app)) {
        for (const std::string& name : option->get_lnames()) {
            names.push_back("--" + name);
        }
    }
    return names;
}

// Text as troff takes it: dashes that may be copied, and no line that it could read as a request.
std::string troff(const std::string& text)
{
    std::string escaped;
    bool lineStarts = true;
    for (const char c : text) {
        if (lineStarts && (c == '.' || c == '\'')) {
            escaped += "\\&";
        }
        escaped += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
        lineStarts = c == '\n';
    }
    return escaped;
}

std::string namesOf(const CLI::Option& option)
{
    if (option.nonpositional()) {
        std::string names;
        for (const std::string& name : option.get_snames()) {
            names += (names.empty() ? "-" : ", -") + name;
        }
        for (const std::string& name : option.get_lnames()) {
            names += (names.empty() ? "--" : ", --") + name;
        }
        return names;
    }
    return option.get_name(true);
}

std::string manOption(const CLI::Option& option)
{
    std::string head = fmt::format("\\fB{}\\fR", troff(namesOf(option)));
    if (!option.get_type_name().empty() && option.nonpositional()) {
        head += fmt::format(" \\fI{}\\fR", troff(option.get_type_name()));
    }
    std::string text = troff(option.get_description());
    if (option.get_type_size() != 0 && !option.get_default_str().empty()) {
        text += fmt::format(" (default: {})", troff(option.get_default_str()));
    }
    return fmt::format(".TP\n{}\n{}\n", head, text);
}

std::string usageOf(const CLI::App& command)
{
    std::string usage = fmt::format("\\fBnacre {}\\fR [\\fIoptions\\fR]", command.get_name());
    for (const CLI::Option* option : shownOptions(command)) {
        if (!option->nonpositional()) {
            const std::string name = troff(option->get_name(true));
            usage += option->get_required() ? fmt::format(" \\fI{}\\fR", name) : fmt::format(" [\\fI{}\\fR]", name);
        }
    }
    return usage;
}

std::string manCommand(const CLI::App& command)
{
    std::string name = command.get_name();
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::toupper(c); });
    std::string page =
        fmt::format(".SH NACRE {}\n{}\n.PP\n{}\n", troff(name), usageOf(command), troff(command.get_description()));
    for (const std::string& group : command.get_groups()) {
        const auto options = command.get_options([&](const CLI::Option* o) { return o->get_group() == group; });
        if (!group.empty() && !options.empty()) {
            page += fmt::format(".SS {}\n", troff(group));
            for (const CLI::Option* option : options) {
                page += manOption(*option);
            }
        }
    }
    if (!command.get_footer().empty()) {
        page += fmt::format(".PP\n.nf\n{}\n.fi\n", troff(command.get_footer()));
    }
    return page;
}

// What a shell and man(1) show, made from the tree of commands and options, so that it cannot differ from --help.
std::string bashCompletion(const CLI::App& app)
{
    std::string commands, cases;
    for (const CLI::App* command : commandsOf(app)) {
        commands += command->get_name() + " ";
        cases += fmt::format("        {}) words=\"{}\" ;;\n", command->get_name(), fmt::join(longNames(*command), " "));
    }
    return fmt::format(R"(# bash completion for nacre: commands, then long options; file names where neither fits
_nacre() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} words=
    COMPREPLY=()
    if [ "$COMP_CWORD" = 1 ]; then
        words="{}{}"
    elif [[ $word != -* ]]; then
        return
    else
        case ${{COMP_WORDS[1]}} in
{}        esac
    fi
    COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o default -F _nacre nacre
)",
                       commands, fmt::join(longNames(app), " "), cases);
}

std::string manPage(const CLI::App& app, const std::string& version)
{
    std::string page =
        fmt::format(".TH NACRE 1 \"\" \"nacre {}\" \"User Commands\"\n.SH NAME\nnacre \\- materials measured "
                    "from photographs and relit\n.SH SYNOPSIS\n\\fBnacre\\fR \\fIcommand\\fR "
                    "[\\fIoptions\\fR]\n.SH DESCRIPTION\n{}\n.SH COMMANDS\n",
                    version, troff(app.get_description()));
    for (const CLI::App* command : commandsOf(app)) {
        page += fmt::format(".TP\n\\fB{}\\fR\n{}\n", troff(command->get_name()), troff(command->get_description()));
    }
    for (const CLI::App* command : commandsOf(app)) {
        page += manCommand(*command);
    }
    return page +
           ".SH EXIT STATUS\n0 if all went well, 1 if a check failed, 2 for a command line that is not understood, "
           "3 for data that cannot be used; one line on standard error says why.\n";
}

// What was printed may still wait to be written.
void requirePrinted()
{
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        throw Error("standard output", fmt::format("cannot be written: {}", std::strerror(errno)),
                    "a file or pipe that takes what is printed");
    }
}

constexpr int kInternalError = 70; // EX_SOFTWARE of sysexits.h

// The page to read, after what may have been meant.
std::string adviceFor(const std::string& typed, const std::vector<std::string>& names, const std::string& page)
{
    const std::string nearest = nearestName(typed.substr(0, typed.find('=')), names);
    return nearest.empty() ? "see " + page : fmt::format("did you mean {}? See {}", nearest, page);
}

// CLI11's message as one line of the program's own form, with the command whose help answers it.
Error usageError(const CLI::App& app, const CLI::ParseError& e)
{
    const auto commands = app.get_subcommands();
    if (commands.empty()) {
        const std::vector<std::string> unknown = app.remaining();
        if (unknown.empty()) {
            return {"", "no command is given", "see nacre --help", Error::kUsage};
        }
        std::vector<std::string> names;
        for (const CLI::App* command : commandsOf(app)) {
            names.push_back(command->get_name());
        }
        return {"", fmt::format("'{}' is no command", unknown.front()),
                adviceFor(unknown.front(), names, "nacre --help"), Error::kUsage};
    }
    const CLI::App& command = *commands.front();
    const std::string page = fmt::format("nacre {} --help", command.get_name());
    const std::vector<std::string> unknown = command.remaining();
    if (!unknown.empty()) {
        const char* what = unknown.front()[0] == '-' ? "is no option here" : "was not expected";
        return {"", fmt::format("'{}' {}", unknown.front(), what), adviceFor(unknown.front(), longNames(command), page),
                Error::kUsage};
    }
    std::string text = e.what();
    const std::string unconverted = "Could not convert: ";
    if (text.rfind(unconverted, 0) == 0) {
        text = fmt::format("'{}' is not understood", text.substr(unconverted.size()));
    } else if (text.size() > 1 && std::islower(static_cast<unsigned char>(text[1]))) {
        text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
    }
    return {"", text, "see " + page, Error::kUsage};
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
    print("--bash-completion", [&app] { return bashCompletion(app); });
    print("--man-page", [&app] { return manPage(app, NACRE_VERSION); });
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
} // namespace nacre

int main(int argc, char** argv)
{
    nacre::removeUnfinishedOnSignals();
    try {
        const int status = nacre::runCommandLine(argc, argv);
        nacre::requirePrinted();
        return status;
    } catch (const nacre::Error& e) {
        std::fprintf(stderr, "nacre: %s\n", e.what());
        return e.exitCode();
    } catch (const std::filesystem::filesystem_error& e) {
        std::fprintf(stderr, "nacre: %s: %s; a place that may be read and written\n", e.path1().c_str(),
                     e.code().message().c_str());
        return nacre::Error::kData;
    } catch (const std::system_error& e) { // of fmt::print, where standard output is closed or full
        std::fprintf(stderr,
                     "nacre: standard output: cannot be written: %s; a file or pipe that takes what is printed\n",
                     e.code().message().c_str());
        return nacre::Error::kData;
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "nacre: not enough memory; fewer or smaller pictures\n");
        return nacre::Error::kData;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "nacre: internal error: %s\n", e.what());
        return nacre::kInternalError;
    }
}
