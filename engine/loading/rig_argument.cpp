#include "engine/loading/rig_argument.h"

#include <charconv>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/files/error.h"
#include "engine/lights/environment.h"
#include "engine/lights/light_files.h"
#include "engine/lights/light_rigs.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

LightRig rigOfFile(const fs::path& file)
{
    const std::string extension = file.extension().string();
    if (extension == ".exr" || extension == ".hdr") {
        return {file.stem().string(), lightsFromEnvironment(loadEnvironment(file), kEnvironmentLights)};
    }
    LightRig rig{file.stem().string(), loadLightFile(file).lights};
    if (rig.lights.empty()) {
        throw Error(file, "holds no light", "lights as nacre calibrate writes them");
    }
    return rig;
}

LightRig lightOfRig(const fs::path& file, const std::string& digits)
{
    LightRig rig = rigOfFile(file);
    size_t number = 0;
    const char* end = digits.data() + digits.size();
    const auto [next, error] = std::from_chars(digits.data(), end, number);
    if (error != std::errc() || next != end || number < 1 || number > rig.lights.size()) {
        throw Error(file, fmt::format("has no light #{}", digits), fmt::format("#1 to #{}", rig.lights.size()),
                    Error::kUsage);
    }
    return {fmt::format("{}-{}", rig.name, number), {rig.lights[number - 1]}};
}

} // namespace

LightRig rigFromArgument(const std::string& text)
{
    if (fs::is_regular_file(text)) {
        return rigOfFile(text);
    }
    const size_t mark = text.rfind('#');
    if (mark != std::string::npos && fs::is_regular_file(text.substr(0, mark))) {
        return lightOfRig(text.substr(0, mark), text.substr(mark + 1));
    }
    if (fs::path(text).has_extension()) {
        throw Error(text, "does not exist", fmt::format("a file of lights, or one of {}", fmt::join(rigNames(), ", ")));
    }
    return {text, lightsOfRig(text)};
}

} // namespace nacre
