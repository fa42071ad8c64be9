#include "engine/view_state/recent_files.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "engine/files/error.h"
#include "engine/files/whole_file.h"

namespace nacre {
namespace fs = std::filesystem;

fs::path recentFilesList()
{
    const char *state = std::getenv("XDG_STATE_HOME"), *home = std::getenv("HOME");
    if (state != nullptr && fs::path(state).is_absolute()) { // others are to be ignored, as the specification says
        return fs::path(state) / "nacre" / "recent";
    }
    return home != nullptr && *home != '\0' ? fs::path(home) / ".local/state/nacre/recent" : fs::path();
}

RecentFiles::RecentFiles(fs::path list) : list_(std::move(list))
{
    read();
}

// As it is now: another window may have written it.
void RecentFiles::read()
{
    std::error_code none;
    if (list_.empty() || !fs::is_regular_file(list_, none)) {
        return;
    }
    try {
        std::istringstream lines(readTextFile(list_));
        files_.clear();
        for (std::string line; files_.size() < kMost && std::getline(lines, line);) {
            if (fs::path(line).is_absolute()) {
                files_.emplace_back(line);
            }
        }
    } catch (const Error&) {
        files_.clear(); // as of a list that is not there
    }
}

void RecentFiles::note(const fs::path& file)
{
    const fs::path normal = fs::absolute(file).lexically_normal();
    const fs::path opened = normal.has_filename() ? normal : normal.parent_path(); // a slash at the end
    if (list_.empty() || opened.string().find('\n') != std::string::npos) {
        return;
    }
    read();
    std::erase(files_, opened);
    files_.insert(files_.begin(), opened);
    files_.resize(std::min(files_.size(), kMost));
    std::string text;
    for (const fs::path& recent : files_) {
        text += recent.string() + "\n";
    }
    try {
        std::error_code none;
        fs::create_directories(list_.parent_path(), none);
        writeTextFile(list_, text);
    } catch (const Error&) { // the list is this window's alone then
    }
}

} // namespace nacre
