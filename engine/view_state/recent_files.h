#pragma once
#include <filesystem>
#include <vector>

namespace nacre {

// The user's: nacre/recent in $XDG_STATE_HOME or, by the XDG Base Directory Specification, ~/.local/state. Empty where
// there is no home.
std::filesystem::path recentFilesList();

// Surfaces that were opened last, kept in a text file: a path a line, the newest first.
class RecentFiles {
public:
    static constexpr size_t kMost = 8;

    // Empty: nothing is kept.
    explicit RecentFiles(std::filesystem::path list);
    const std::vector<std::filesystem::path>& files() const { return files_; }
    // Was opened just now. A list that cannot be written is no reason to stop: it is then this window's alone.
    void note(const std::filesystem::path& file);

private:
    void read();

    std::filesystem::path list_;
    std::vector<std::filesystem::path> files_;
};

} // namespace nacre
