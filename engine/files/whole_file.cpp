#include "engine/files/whole_file.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

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

} // namespace

WholeOutput::WholeOutput(fs::path destination, bool replace)
    : destination_(withoutTrailingSlash(std::move(destination))), temporary_(temporaryBeside(destination_)),
      replace_(replace)
{
    if (destination_.empty()) {
        throw Error("", "an output without a name", "a path", Error::kUsage);
    }
    if (fs::exists(destination_) && !replace_) {
        throw Error(destination_, "exists already", "a new name, or leave to replace it");
    }
    const fs::path parent = destination_.parent_path();
    if (!parent.empty() && !fs::is_directory(parent)) {
        throw Error(destination_, "its folder does not exist", "an existing folder to write into");
    }
}

WholeOutput::~WholeOutput()
{
    std::error_code ignored;
    fs::remove_all(temporary_, ignored);
}

// A folder cannot be renamed over a full one or over a file: the old one steps aside first, and comes back if the
// rename fails.
void WholeOutput::commit()
{
    std::error_code error;
    const bool folders = fs::is_directory(destination_, error) || fs::is_directory(temporary_, error);
    if (!folders || !fs::exists(destination_)) {
        fs::rename(temporary_, destination_, error);
    } else {
        const fs::path aside = temporary_.string() + ".old";
        fs::rename(destination_, aside, error);
        if (!error) {
            fs::rename(temporary_, destination_, error);
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

TemporaryFolder::TemporaryFolder()
{
    std::error_code error;
    const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
    std::string name = (parent / "nacre-XXXXXX").string();
    if (error || !mkdtemp(name.data())) {
        throw Error(name, fmt::format("cannot be made: {}", error ? error.message() : std::strerror(errno)),
                    "a writable folder for temporary files (TMPDIR)");
    }
    path_ = name;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

} // namespace nacre
