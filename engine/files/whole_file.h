#pragma once
#include <filesystem>
#include <span>
#include <string>

namespace nacre {

// A place to write that becomes `destination` by commit() alone; without it, nothing stays behind. `destination` may
// be a file or a folder.
class WholeOutput {
public:
    // Refuses an existing destination without `replace` and a missing parent folder.
    WholeOutput(std::filesystem::path destination, bool replace);
    ~WholeOutput();
    WholeOutput(const WholeOutput&) = delete;
    WholeOutput& operator=(const WholeOutput&) = delete;

    const std::filesystem::path& temporary() const { return temporary_; }
    void commit();

private:
    std::filesystem::path destination_;
    std::filesystem::path temporary_;
    bool replace_;
};

// Whole or not at all, in place of what was there; Error where the disk refuses.
void writeWholeFile(const std::filesystem::path& file, std::span<const unsigned char> bytes);
void writeTextFile(const std::filesystem::path& file, const std::string& text);
std::string readTextFile(const std::filesystem::path& file);
// The bytes of a file; the error says that `expected` was wanted.
std::string readWholeFile(const std::filesystem::path& file, const std::string& expected);

// A folder of the system's temporary place, removed with all that is in it. Throws Error where none can be made.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace nacre
