#include "engine/files/whole_file.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "engine/files/error.h"

namespace nacre {

namespace fs = std::filesystem;

namespace {

fs::path withoutTrailingSlash(fs::path path)
{
    return path.has_filename() ? path : path.parent_path();
}

// Beside the destination, so that the rename stays on one file system; the extension stays last, since it names the
// format to picture writers.
fs::path temporaryBeside(const fs::path& destination)
{
    return destination.parent_path() /
           fmt::format(".{}.{}.part{}", destination.stem().string(), getpid(), destination.extension().string());
}

constexpr int kMostLinks = 40; // as Linux follows

// What links lead to, there or not, so that it is replaced and not the link.
fs::path behindLinks(const fs::path& path)
{
    std::error_code ignored;
    fs::path file = path;
    for (int i = 0; fs::is_symlink(file, ignored); ++i) {
        if (i == kMostLinks) {
            throw Error(path, "is a link that leads back to itself", "a link to a file or folder");
        }
        file = file.parent_path() / fs::read_symlink(file);
    }
    return file;
}

// N of /dev/fd/N and its other names; -1 for every other path.
int descriptorNamed(const fs::path& file)
{
    const std::string& name = file.native();
    constexpr const char* kStandard[] = {"/dev/stdin", "/dev/stdout", "/dev/stderr"};
    const auto standard = std::find(std::begin(kStandard), std::end(kStandard), name);
    if (standard != std::end(kStandard)) {
        return static_cast<int>(standard - std::begin(kStandard));
    }
    const fs::path folder = file.parent_path();
    const std::string number = file.filename();
    int descriptor = -1;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), descriptor);
    const bool isNumber = error == std::errc() && end == number.data() + number.size();
    return isNumber && (folder == "/dev/fd" || folder == "/proc/self/fd") ? descriptor : -1;
}

void writeThrough(int descriptor, const fs::path& file, std::span<const unsigned char> bytes)
{
    std::fflush(stdout); // what was printed before comes before
    while (!bytes.empty()) {
        const ssize_t written = write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno != EINTR) {
            throw Error(file, fmt::format("cannot be written: {}", std::strerror(errno)), "a stream that takes bytes");
        }
        bytes = bytes.subspan(static_cast<size_t>(std::max<ssize_t>(written, 0)));
    }
}

void writeStream(const fs::path& file, std::span<const unsigned char> bytes)
{
    const int named = descriptorNamed(file), descriptor = named >= 0 ? dup(named) : open(file.c_str(), O_WRONLY);
    if (descriptor < 0) {
        throw Error(file, fmt::format("cannot be opened: {}", std::strerror(errno)), "a stream that may be written");
    }
    try {
        writeThrough(descriptor, file, bytes);
    } catch (...) {
        close(descriptor);
        throw;
    }
    close(descriptor);
}

// The part of WholeOutput's promise that can change while the work is done.
void requireSameKind(const fs::path& temporary, const fs::path& destination)
{
    const fs::file_type there = fs::status(destination).type();
    if (there != fs::file_type::not_found && there != fs::status(temporary).type()) {
        throw Error(destination, there == fs::file_type::directory ? "is a folder" : "is no folder",
                    "the same kind, or a new name");
    }
}

} // namespace

bool isStream(const fs::path& file)
{
    std::error_code ignored;
    const fs::file_status status = fs::status(file, ignored);
    return descriptorNamed(file) >= 0 || fs::is_character_file(status) || fs::is_fifo(status);
}

WholeOutput::WholeOutput(fs::path destination, bool replace)
    : destination_(behindLinks(withoutTrailingSlash(std::move(destination)))), temporary_(temporaryBeside(destination_))
{
    if (destination_.empty()) {
        throw Error("", "an output without a name", "a path", Error::kUsage);
    }
    if (fs::exists(destination_) && !replace) {
        throw Error(destination_, "exists already", "a new name, or leave to replace it");
    }
    if (fs::exists(destination_) && !fs::is_regular_file(destination_) && !fs::is_directory(destination_)) {
        throw Error(destination_, "is neither file nor folder", "a new name");
    }
    const fs::path parent = destination_.parent_path();
    if (!parent.empty() && !fs::is_directory(parent)) {
        throw Error(destination_, "its folder does not exist", "an existing folder to write into");
    }
}

// A folder cannot be renamed over a full one: the old one steps aside first, and comes back if the rename fails.
void WholeOutput::commit()
{
    const std::unique_lock lock = holdUnfinished();
    requireSameKind(temporary(), destination_);
    std::error_code error;
    if (!fs::is_directory(destination_)) {
        fs::rename(temporary(), destination_, error);
    } else {
        const fs::path aside = temporary().string() + ".old";
        fs::rename(destination_, aside, error);
        if (!error) {
            fs::rename(temporary(), destination_, error);
            std::error_code ignored;
            if (error) {
                fs::rename(aside, destination_, ignored);
            } else {
                fs::remove_all(aside, ignored);
            }
        }
    }
    if (error) {
        throw Error(destination_, "cannot be written: " + error.message(), "a place to write to");
    }
}

void writeWholeFile(const fs::path& file, std::span<const unsigned char> bytes)
{
    if (isStream(file)) {
        writeStream(file, bytes);
        return;
    }
    WholeOutput output(file, true);
    std::FILE* stream = std::fopen(output.temporary().c_str(), "wb");
    const bool written = stream && std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size();
    const int writeError = errno;
    const bool closed = stream && std::fclose(stream) == 0;
    if (!written || !closed) {
        throw Error(file, fmt::format("cannot be written: {}", std::strerror(written ? errno : writeError)),
                    "a writable place with room");
    }
    output.commit();
}

void writeTextFile(const fs::path& file, const std::string& text)
{
    writeWholeFile(file, std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

std::string readTextFile(const fs::path& file)
{
    return readWholeFile(file, "a text file");
}

std::string readWholeFile(const fs::path& file, const std::string& expected)
{
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    if (!stream || fs::is_directory(file)) {
        throw Error(file, "cannot be read", expected);
    }
    text << stream.rdbuf();
    return text.str();
}

namespace {

fs::path makeTemporaryFolder()
{
    std::error_code error;
    const fs::path parent = fs::temp_directory_path(error);
    std::string name = (parent / "nacre-XXXXXX").string();
    if (error || !mkdtemp(name.data())) {
        throw Error(name, fmt::format("cannot be made: {}", error ? error.message() : std::strerror(errno)),
                    "a writable folder for temporary files (TMPDIR)");
    }
    return name;
}

} // namespace

TemporaryFolder::TemporaryFolder() : Unfinished(makeTemporaryFolder()) {}

} // namespace nacre
