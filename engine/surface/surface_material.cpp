#include "engine/surface/surface_material.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/files/text_files.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

// The last "#", behind which a material is named; npos where the text is a folder as a whole.
size_t markOf(const std::string& specification)
{
    return fs::is_directory(specification) ? std::string::npos : specification.rfind('#');
}

bool isSurfaceName(const fs::path& folder)
{
    return fs::is_directory(folder) || lowerExtension(folder) == ".nacre";
}

// From 1; 0 where the text is no such number.
size_t numberFrom(const std::string& text)
{
    size_t number = 0;
    const char* end = text.data() + text.size();
    const auto [next, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && next == end ? number : 0;
}

size_t indexOf(const Surface& surface, const std::string& selector, const fs::path& folder)
{
    const auto& materials = surface.materials;
    const auto named = std::find_if(materials.begin(), materials.end(),
                                    [&](const Material& material) { return material.name == selector; });
    if (named != materials.end()) {
        return static_cast<size_t>(named - materials.begin());
    }
    const size_t number = numberFrom(selector);
    if (number < 1 || number > materials.size()) {
        std::string names;
        for (size_t i = 0; i < materials.size(); ++i) {
            names += fmt::format("{}#{} ({})", i == 0 ? "" : ", ", i + 1, materials[i].name);
        }
        throw Error(folder, fmt::format("holds no material #{}", selector), names, Error::kUsage);
    }
    return number - 1;
}

} // namespace

std::optional<SurfaceMaterial> loadSurfaceMaterial(const std::string& specification)
{
    const size_t mark = markOf(specification);
    const fs::path folder = specification.substr(0, mark);
    if (folder.empty() || !isSurfaceName(folder)) {
        return std::nullopt;
    }
    Surface surface = loadSurface(folder);
    if (surface.materials.empty()) {
        throw Error(folder, "holds no material", "a surface that `nacre acquire` or `nacre materials` wrote");
    }
    const size_t index = mark == std::string::npos ? 0 : indexOf(surface, specification.substr(mark + 1), folder);
    return SurfaceMaterial{std::move(surface.materials[index]), surface.scale};
}

std::string specificationOf(const std::string& folder, const Surface& surface, size_t index)
{
    const auto& materials = surface.materials;
    const std::string& name = materials[index].name;
    const auto same = std::count_if(materials.begin(), materials.end(),
                                    [&](const Material& material) { return material.name == name; });
    if (materials.size() == 1) {
        return folder;
    }
    return same > 1 || name.empty() ? fmt::format("{}#{}", folder, index + 1) : folder + "#" + name;
}

} // namespace nacre
