#include "engine/view_state/dropped_file.h"

#include <string>

#include "engine/files/error.h"
#include "engine/files/image.h"
#include "engine/files/text_files.h"
#include "engine/files/whole_file.h"

namespace nacre {

namespace {

Dropped kindOfFolder(const std::filesystem::path& folder)
{
    if (!std::filesystem::exists(folder / "surface.json")) {
        return Dropped::unknown;
    }
    return std::filesystem::exists(folder / "material_0.exr") ? Dropped::surface : Dropped::target;
}

Dropped kindOfPicture(const std::filesystem::path& file)
{
    try {
        return readImageAttribute(file, "nacre:brdfTable").empty() ? Dropped::target : Dropped::material;
    } catch (const Error&) {
        return Dropped::unknown;
    }
}

} // namespace

Dropped kindOf(const std::filesystem::path& file)
{
    if (std::filesystem::is_directory(file)) {
        return kindOfFolder(file);
    }
    const std::string extension = lowerExtension(file);
    if (extension == ".json") {
        return Dropped::state;
    }
    if (extension == ".binary" || extension == ".bsdf") {
        return Dropped::material;
    }
    return extension == ".hdr" ? Dropped::environment : kindOfPicture(file);
}

} // namespace nacre
