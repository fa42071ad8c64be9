#include "app/arguments/destinations.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

#include "engine/files/error.h"
#include "engine/files/whole_file.h"
#include "engine/surface/surface.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr const char* kFreeName = "a new name, or --force to replace it";

void requireWritable(const fs::path& output, const fs::path& folder)
{
    if (access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) != 0) {
        throw Error(output, "its folder may not be written", "a folder with the right to write");
    }
}

void requireFree(const fs::path& output, bool replace)
{
    if (!replace && fs::exists(output)) {
        throw Error(output, "exists already", kFreeName);
    }
    const WholeOutput allowed(output, true);
    requireWritable(output, (output.has_filename() ? output : output.parent_path()).parent_path());
}

bool holds(const fs::path& folder, const std::string& mark)
{
    const fs::directory_iterator entries(folder);
    return std::any_of(begin(entries), end(entries), [&](const fs::directory_entry& entry) {
        return entry.path().filename().native().starts_with(mark);
    });
}

bool isStandardOutput(const fs::path& file)
{
    return file == "-" || file == "/dev/stdout" || file == "/dev/fd/1" || file == "/proc/self/fd/1";
}

// Standard output as the program was given it, once what is printed goes to standard error.
int summaryDescriptor = -1;

void printToStandardError()
{
    std::fflush(stdout);
    summaryDescriptor = dup(STDOUT_FILENO);
    dup2(STDERR_FILENO, STDOUT_FILENO);
}

} // namespace

void requireFile(const fs::path& file, bool replace)
{
    if (file.empty() || isStream(file)) {
        return;
    }
    if (fs::is_directory(file)) {
        throw Error(file, "is a folder", "the name of a file");
    }
    if (replace && fs::exists(file) && fs::exists(file.parent_path() / kSurfaceDescription)) {
        throw Error(file, "lies in a surface, whose files belong together", "a name outside its folder");
    }
    requireFree(file, replace);
}

void requireWholeFolder(const fs::path& folder, bool replace, const std::string& mark)
{
    if (folder.empty()) {
        return;
    }
    requireFree(folder, replace);
    if (fs::exists(folder) && !fs::is_directory(folder)) {
        throw Error(folder, "is no folder", "a new name: --force replaces folders by folders alone");
    }
    if (fs::exists(folder) && !fs::is_empty(folder) && !holds(folder, mark)) {
        throw Error(folder, fmt::format("holds no {}", mark),
                    "a new name: --force replaces what the same command wrote, and nothing else");
    }
}

void requirePictureFolder(const fs::path& folder, bool replace)
{
    fs::path existing = folder;
    while (!existing.empty() && !fs::exists(existing)) {
        existing = existing.parent_path();
    }
    if (!existing.empty() && !fs::is_directory(existing)) {
        throw Error(folder, existing == folder ? "is no folder" : "lies below " + existing.string() + ", a file",
                    "a folder for pictures");
    }
    if (!folder.empty()) {
        requireWritable(folder, existing);
        if (existing == folder && !fs::is_empty(folder) && !replace) {
            throw Error(folder, "exists already and is not empty",
                        "a new name, or --force to replace the files in it that have the same names");
        }
    }
}

void requireSummary(const fs::path& file, bool replace)
{
    if (isStandardOutput(file)) {
        printToStandardError();
    } else {
        requireFile(file, replace);
    }
}

void writeSummaryText(const fs::path& file, const std::string& text)
{
    if (!isStandardOutput(file)) {
        writeTextFile(file, text);
        return;
    }
    try {
        writeTextFile(fs::path("/dev/fd") / std::to_string(summaryDescriptor), text);
    } catch (const Error&) { // which names the descriptor
        throw Error("standard output", "cannot be written", "a file or pipe that takes what is printed");
    }
}

} // namespace nacre
