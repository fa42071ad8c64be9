#pragma once
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <sys/wait.h>

#include "tests/support/temp_folder.h"

namespace nacre {

struct ProgramRun {
    int exitCode = -1;
    std::string out;
    std::string err;
};

// `environment` as a shell has it in front of a command, e.g. "NAME=value".
inline ProgramRun runProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                             const std::string& environment = "")
{
    const auto contentOf = [](const std::filesystem::path& file) {
        std::stringstream text;
        text << std::ifstream(file).rdbuf();
        return text.str();
    };
    const TempFolder folder;
    std::string command = environment + " '" + program.string() + "'";
    for (const std::string& argument : arguments) {
        command += " '" + argument + "'";
    }
    command += " > '" + (folder / "out").string() + "' 2> '" + (folder / "err").string() + "'";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentOf(folder / "out"), contentOf(folder / "err")};
}

// Starts nacre as its users do.
inline ProgramRun runNacre(const std::vector<std::string>& arguments, const std::string& environment = "")
{
    return runProgram(NACRE_EXECUTABLE, arguments, environment);
}

} // namespace nacre
