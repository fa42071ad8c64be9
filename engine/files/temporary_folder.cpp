#include "engine/files/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>

#include "engine/files/error.h"

namespace nacre {

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
