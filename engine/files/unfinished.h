#pragma once
#include <filesystem>
#include <mutex>

namespace nacre {

// A file or folder that is removed with all that is in it when this object goes, or when SIGINT, SIGTERM or SIGHUP
// ends the program.
class Unfinished {
public:
    explicit Unfinished(std::filesystem::path path);
    ~Unfinished();
    Unfinished(const Unfinished&) = delete;
    Unfinished& operator=(const Unfinished&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

// While it is held, no signal removes anything or ends the program: for steps that belong together.
std::unique_lock<std::mutex> holdUnfinished();

// To be called by main before any thread is started. A handler of these signals that is set later is called on a
// thread of its own and ends nothing by itself.
void removeUnfinishedOnSignals();

} // namespace nacre
