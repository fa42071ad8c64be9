#include "acquisition/capture/light_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <regex>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "acquisition/capture/picture_files.h"
#include "engine/files/error.h"
#include "engine/files/text_files.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr uintmax_t kLongestList = 1 << 20; // bytes; other tables of numbers may be of any length
// Of numbers that are rounded to two places; other triples are no unit vectors.
constexpr double kUnitLength = 0.02;

struct ListBeside {
    fs::path file;
    LightFile lights;
};

bool isNamedIntensities(const fs::path& file)
{
    const std::string name = lowerCase(file.stem().string());
    return name.find("intens") != std::string::npos || name.find("irradiance") != std::string::npos;
}

fs::path folderOf(const LayoutContents& contents)
{
    return fs::is_directory(contents.listing) ? contents.listing : contents.listing.parent_path();
}

// Files beside the photographs that may be lists, in order of their names.
std::set<fs::path> textsIn(const fs::path& folder)
{
    static const std::set<std::string> kExtensions = {".txt", ".csv", ".dat", ".npy", ".yml", ".yaml", ".json"};
    std::set<fs::path> files;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, ignored)) {
        if (!entry.path().filename().string().starts_with('.') && kExtensions.contains(lowerExtension(entry.path())) &&
            entry.is_regular_file(ignored) && entry.file_size(ignored) <= kLongestList) {
            files.insert(entry.path());
        }
    }
    return files;
}

std::vector<ListBeside> listsIn(const fs::path& folder)
{
    std::vector<ListBeside> lists;
    for (const fs::path& file : textsIn(folder)) {
        try {
            if (!isNamedIntensities(file)) {
                lists.push_back({file, loadLightFile(file)});
            }
        } catch (const Error&) { // it is something else
        }
    }
    return lists;
}

// Those of the one file that is named so and has as many.
void addIrradiancesBeside(const fs::path& folder, LightFile& lights)
{
    for (const fs::path& file : textsIn(folder)) {
        if (isNamedIntensities(file) && !lights.irradianceGiven) {
            addIrradiances(lights, file);
        }
    }
}

using Numbers = std::array<double, 3>;
using Direction = std::optional<glm::dvec3> (*)(const Numbers&);

std::optional<glm::dvec3> unitVector(const Numbers& n)
{
    const glm::dvec3 v(n[0], n[1], n[2]);
    return std::abs(glm::length(v) - 1) < kUnitLength ? std::optional(v) : std::nullopt;
}

std::optional<glm::dvec3> polar(const Numbers& n)
{
    const double theta = glm::radians(n[0]), phi = glm::radians(n[1]);
    return glm::dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
}

// Georghiades, Belhumeur and Kriegman, From Few to Many (the Yale face database B), 2001: azimuth and elevation with
// respect to the camera's axis.
std::optional<glm::dvec3> azimuthElevation(const Numbers& n)
{
    const double azimuth = glm::radians(n[0]), elevation = glm::radians(n[1]);
    return glm::dvec3(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                      std::cos(azimuth) * std::cos(elevation));
}

struct Notation {
    std::regex pattern;
    Direction direction;
};

const std::vector<Notation>& notations()
{
    static const std::string decimal = "([+-]?[0-9]*[.][0-9]+)", degrees = "[_= ]?([0-9]+(?:[.][0-9]+)?)";
    static const std::vector<Notation> known = {
        {std::regex("(?:^|[_, x])" + decimal + "[_, ]y?" + decimal + "[_, ]z?" + decimal + "$"), unitVector},
        {std::regex("(?:theta|tl)" + degrees + "[_, -]*(?:phi|pl)" + degrees), polar},
        {std::regex("a([+-][0-9]{3})e([+-][0-9]{2,3})"), azimuthElevation},
    };
    return known;
}

// Of a name by a notation; none where it has another.
std::optional<glm::dvec3> directionOf(const std::string& name, const Notation& notation)
{
    const std::string stem = lowerCase(fs::path(name).stem().string());
    std::smatch match;
    if (!std::regex_search(stem, match, notation.pattern)) {
        return std::nullopt;
    }
    Numbers numbers{};
    for (size_t i = 1; i < match.size(); ++i) {
        const std::string text = match[i].str();
        numbers[i - 1] = parseNumber(text).value_or(0);
    }
    return notation.direction(numbers);
}

std::optional<LightFile> directionsInNames(const std::vector<Photograph>& photographs)
{
    for (const Notation& notation : notations()) {
        LightFile found;
        for (const Photograph& photograph : photographs) {
            if (const auto direction = directionOf(photograph.name, notation)) {
                found.lights.push_back({glm::vec3(glm::normalize(*direction)), glm::vec3(1)});
                found.vectors.push_back(found.lights.back().direction);
                found.photographs.push_back(photograph.name);
            }
        }
        if (!photographs.empty() && found.lights.size() == photographs.size()) {
            return found;
        }
    }
    return std::nullopt;
}

// "12 .png of 640x480, 1 .jpg of 64x48"
std::string kindsOf(const std::vector<Photograph>& photographs)
{
    std::map<std::string, size_t> counts;
    for (const Photograph& photograph : photographs) {
        for (const Exposure& exposure : photograph.exposures) {
            std::string kind = lowerExtension(exposure.file);
            try {
                const ImageHeader header = readImageHeader(exposure.file);
                kind += fmt::format(" of {}x{}", header.width, header.height);
            } catch (const Error&) {
                kind += " that cannot be read";
            }
            ++counts[kind];
        }
    }
    std::vector<std::string> kinds;
    for (const auto& [kind, count] : counts) {
        kinds.push_back(fmt::format("{} {}", count, kind));
    }
    constexpr size_t kMost = 4;
    if (kinds.size() > kMost) {
        const size_t others = kinds.size() - kMost;
        kinds.resize(kMost);
        kinds.push_back(fmt::format("pictures of {} other sizes", others));
    }
    return fmt::format("{}", fmt::join(kinds, ", "));
}

} // namespace

std::optional<FoundLights> searchLights(const LayoutContents& contents, size_t skipped)
{
    const size_t all = contents.capture.photographs.size();
    std::vector<ListBeside> fitting;
    for (ListBeside& list : listsIn(folderOf(contents))) {
        const size_t count = list.lights.lights.size();
        if (count == all || count + skipped == all) {
            fitting.push_back(std::move(list));
        }
    }
    if (fitting.size() > 1) {
        throw Error(folderOf(contents),
                    fmt::format("holds several lists of {} lights, {} and {} among them", all,
                                fitting[0].file.filename().string(), fitting[1].file.filename().string()),
                    "one, or the choice by --rig");
    }
    if (fitting.size() == 1) {
        addIrradiancesBeside(folderOf(contents), fitting[0].lights);
        return FoundLights{std::move(fitting[0].lights), fitting[0].file};
    }
    if (auto named = directionsInNames(contents.capture.photographs)) {
        return FoundLights{std::move(*named), "the photographs' names"};
    }
    return std::nullopt;
}

Error withoutLights(const LayoutContents& contents)
{
    std::string found = kindsOf(contents.capture.photographs);
    for (const fs::path& mask : contents.masks) {
        found += ", the mask " + mask.filename().string();
    }
    const std::vector<ListBeside> lists = listsIn(folderOf(contents));
    const auto isListed = [&](const fs::path& file) {
        return std::any_of(lists.begin(), lists.end(), [&](const ListBeside& list) { return list.file == file; });
    };
    for (const ListBeside& list : lists) {
        found += fmt::format(", {} with {} lights", list.file.filename().string(), list.lights.lights.size());
    }
    for (const fs::path& file : textsIn(folderOf(contents))) {
        if (lowerExtension(file) == ".npy" && !isListed(file)) {
            found += fmt::format(", {0}, which is no list (--rig {0} says why)", file.filename().string());
        }
    }
    return Error(
        contents.listing, fmt::format("says nothing of its lights ({})", found),
        "either of\n"
        "  their directions: --rig FILE, a .lp or a list of x y z for each picture in order of names, or in the "
        "names: A_X_Y_Z.png, theta30_phi045\n"
        "  a mirror ball: --mirror-sphere in-picture:X,Y,W,H where one is in the pictures, or the folder of its "
        "own under the same lights");
}

} // namespace nacre
