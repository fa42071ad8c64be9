#include "app/arguments/destinations.h"

#include <unistd.h>

#include "engine/files/error.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

void requireWritable(const fs::path& output, const fs::path& folder)
{
    if (access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) != 0) {
        throw Error(output, "its folder may not be written", "a folder with the right to write");
    }
}

} // namespace

void requireDestination(const fs::path& output, bool replace)
{
    if (fs::exists(output) && !replace) {
        throw Error(output, "exists already", "a new name, or --force to replace it");
    }
    WholeOutput(output, replace);
    requireWritable(output, (output.has_filename() ? output : output.parent_path()).parent_path());
}

void requireSummaryDestination(const fs::path& file)
{
    if (file.empty()) {
        return;
    }
    if (fs::is_directory(file)) {
        throw Error(file, "is a folder", "the name of a file for the summary");
    }
    requireDestination(file, true);
}

void requireFolderDestination(const fs::path& folder)
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
    }
}

} // namespace nacre
