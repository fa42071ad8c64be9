#pragma once
#include <filesystem>
#include <string>

namespace nacre {

// Outputs are checked before the work starts, so that an hour is not lost to a slip of the pen. Each throws Error where
// the output cannot be written: it exists without `replace`, its folder is missing or may not be written. An empty path
// is an output that was not asked for.

// A file that is replaced, unless it lies in a surface, or a stream, which takes it without `replace`.
void requireFile(const std::filesystem::path& file, bool replace);

// A folder that is replaced as a whole, and then only by its like: an entry of it has to begin with `mark`, as one does
// that the command always writes.
void requireWholeFolder(const std::filesystem::path& folder, bool replace, const std::string& mark);

// A folder, made with its parents where it is missing, in which files are replaced and others stay.
void requirePictureFolder(const std::filesystem::path& folder, bool replace);

// A file for a summary; "-" is standard output, which then has the summary alone: what is printed goes to standard
// error.
void requireSummary(const std::filesystem::path& file, bool replace);
void writeSummaryText(const std::filesystem::path& file, const std::string& text);
template <class Json> void writeSummary(const std::filesystem::path& file, const Json& summary)
{
    if (!file.empty()) {
        writeSummaryText(file, summary.dump(2) + "\n");
    }
}

} // namespace nacre
