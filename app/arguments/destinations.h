#pragma once
#include <filesystem>

#include "engine/files/whole_file.h"

namespace nacre {

// Outputs are checked before the work starts, so that an hour is not lost to a slip of the pen. Throws Error where a
// file (or surface folder) cannot be written: it exists without `replace`, its folder is missing or may not be written.
void requireDestination(const std::filesystem::path& output, bool replace);

// The same for a summary, which replaces a file but no folder. Empty: none asked for.
void requireSummaryDestination(const std::filesystem::path& file);
template <class Json> void writeSummary(const std::filesystem::path& file, const Json& summary)
{
    if (!file.empty()) {
        writeTextFile(file, summary.dump(2) + "\n");
    }
}

// For a folder of pictures, which is made with its parents where it is missing. Empty: none asked for.
void requireFolderDestination(const std::filesystem::path& folder);

} // namespace nacre
