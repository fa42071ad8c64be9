#include "engine/view_state/dropped_file.h"

#include <cmath>
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

constexpr float kUnitTolerance = 0.05f;
constexpr double kLeastUnit = 0.9; // of a normal map's pixels that hold something

bool isEnvironment(const std::filesystem::path& file)
{
    const ImageHeader header = readImageHeader(file);
    if (lowerExtension(file) != ".exr" || header.width != 2 * header.height || header.channels < 3) {
        return false;
    }
    const Image picture = loadImage(file);
    size_t unit = 0, all = 0;
    for (size_t i = 0; i < picture.pixelCount(); ++i) {
        const float* p = &picture.values[i * picture.channels];
        const float length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        unit += std::abs(length - 1) < kUnitTolerance;
        all += length > 0;
    }
    return static_cast<double>(unit) < kLeastUnit * static_cast<double>(all);
}

Dropped kindOfPicture(const std::filesystem::path& file)
{
    try {
        return !readImageAttribute(file, "nacre:brdfTable").empty() ? Dropped::material
               : isEnvironment(file)                                ? Dropped::environment
                                                                    : Dropped::target;
    } catch (const Error&) {
        return Dropped::unknown;
    }
}

} // namespace

const char* nameOf(Dropped kind)
{
    switch (kind) {
    case Dropped::surface:
        return "a surface";
    case Dropped::target:
        return "a shape";
    case Dropped::material:
        return "a material";
    case Dropped::environment:
        return "an environment";
    case Dropped::state:
        return "a state file";
    case Dropped::unknown:
        break;
    }
    return "nothing that can be shown";
}

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
