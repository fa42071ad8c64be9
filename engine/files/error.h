#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>

namespace nacre {

// A user's mistake: one line "file: what is wrong; what was expected", caught in main alone. Our own bugs assert.
class Error : public std::runtime_error {
public:
    static constexpr int kCheckFailed = 1;
    static constexpr int kUsage = 2;
    static constexpr int kData = 3;

    Error(const std::filesystem::path& file, const std::string& wrong, const std::string& expected,
          int exitCode = kData)
        : std::runtime_error((file.empty() ? "" : file.string() + ": ") + wrong + "; " + expected), exitCode_(exitCode)
    {
    }
    int exitCode() const { return exitCode_; }

private:
    int exitCode_;
};

} // namespace nacre
