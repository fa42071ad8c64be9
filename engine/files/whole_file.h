#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "engine/files/unfinished.h"

namespace nacre {

// True for a terminal or other character device, a FIFO, or a name of one of the program's open files such as
// /dev/stdout: what is written there replaces nothing.
bool isStream(const std::filesystem::path& file);

// A place to write that becomes `destination` by commit() alone; without it, nothing stays behind. `destination` may
// be a file or a folder, or a link to one, which stays a link.
class WholeOutput {
public:
    // Refuses an existing destination without `replace`, a missing parent folder and what is neither file nor folder.
    WholeOutput(std::filesystem::path destination, bool replace);

    const std::filesystem::path& temporary() const { return temporary_.path(); }
    // Throws Error, and leaves what was there, where it cannot be replaced: a file by a folder or the reverse, too.
    void commit();

private:
    std::filesystem::path destination_;
    Unfinished temporary_;
};

// Whole or not at all, in place of what was there; streams are written through. Error where the disk refuses.
void writeWholeFile(const std::filesystem::path& file, std::span<const unsigned char> bytes);
void writeTextFile(const std::filesystem::path& file, const std::string& text);
std::string readTextFile(const std::filesystem::path& file);
// The bytes of a file; the error says that `expected` was wanted.
std::string readWholeFile(const std::filesystem::path& file, const std::string& expected);

// A folder of the system's temporary place, removed with all that is in it. Throws Error where none can be made.
class TemporaryFolder : public Unfinished {
public:
    TemporaryFolder();
};

} // namespace nacre
