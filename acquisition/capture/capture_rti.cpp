// Reflectance transformation imaging: one .lp file, a count and then "file x y z", or names alone, a line, beside its
// photographs or in a folder above them. The names often carry folders of another machine, so photographs are found by
// name.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "acquisition/capture/capture_layouts.h"
#include "acquisition/capture/picture_files.h"
#include "engine/files/error.h"
#include "engine/files/text_files.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr int kDeepestFolder = 2; // below the .lp file

// Pictures by depth below the .lp file, so that its own folder comes before, say, one of thumbnails.
using PicturePool = std::vector<std::vector<fs::path>>;

void gatherPictures(const fs::path& folder, size_t depth, PicturePool& pool)
{
    pool.resize(std::max(pool.size(), depth + 1));
    const std::vector<fs::path> here = picturesIn(folder);
    pool[depth].insert(pool[depth].end(), here.begin(), here.end());
    if (depth == kDeepestFolder) {
        return;
    }
    std::set<fs::path> subfolders; // in order: a directory lists in any
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        if (entry.is_directory()) {
            subfolders.insert(entry.path());
        }
    }
    for (const fs::path& subfolder : subfolders) {
        gatherPictures(subfolder, depth + 1, pool);
    }
}

// Listed names may have been written on Windows.
std::string withSlashes(std::string name)
{
    std::replace(name.begin(), name.end(), '\\', '/');
    return name;
}

// The one picture that `agrees` in the highest folder that has any; empty where none does.
template <typename Agrees> fs::path findInPool(const PicturePool& pool, const fs::path& lp, Agrees agrees)
{
    for (const std::vector<fs::path>& pictures : pool) {
        const auto first = std::find_if(pictures.begin(), pictures.end(), agrees);
        if (first == pictures.end()) {
            continue;
        }
        const auto second = std::find_if(first + 1, pictures.end(), agrees);
        if (second != pictures.end()) {
            throw Error(lp, fmt::format("lists a photograph that may be {} or {}", first->string(), second->string()),
                        "one photograph of that name");
        }
        return *first;
    }
    return {};
}

// As listed, by file name, by file name in other case, by stem; empty where nothing agrees.
fs::path findPhotograph(const PicturePool& pool, const fs::path& lp, const fs::path& folder, const std::string& listed)
{
    const fs::path name = withSlashes(listed);
    std::error_code ignored;
    if (name.is_relative() && fs::is_regular_file(folder / name, ignored)) {
        return folder / name;
    }
    fs::path found = findInPool(pool, lp, [&](const fs::path& file) { return file.filename() == name.filename(); });
    if (found.empty()) {
        const std::string wanted = lowerCase(name.filename().string());
        found = findInPool(pool, lp, [&](const fs::path& f) { return lowerCase(f.filename().string()) == wanted; });
    }
    if (found.empty()) {
        const std::string wanted = lowerCase(name.stem().string());
        found = findInPool(pool, lp, [&](const fs::path& f) { return lowerCase(f.stem().string()) == wanted; });
    }
    return found;
}

std::vector<fs::path> lpFilesIn(const fs::path& folder)
{
    std::set<fs::path> files;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
        if (entry.is_regular_file() && lowerCase(entry.path().extension().string()) == ".lp") {
            files.insert(entry.path());
        }
    }
    return {files.begin(), files.end()};
}

LayoutContents readLp(const fs::path& lp, const fs::path& folder, const PicturePool& pool)
{
    const LightFile lights = loadLpList(lp);
    LayoutContents contents;
    contents.capture.layout = CaptureLayout::rti;
    contents.listing = lp;
    std::set<fs::path> listed;
    for (const std::string& name : lights.photographs) {
        const fs::path file = findPhotograph(pool, lp, folder, name);
        if (file.empty()) {
            throw Error(lp, fmt::format("lists {}, which is not in {}", name, folder.string()),
                        "each listed photograph beside or below it");
        }
        if (!listed.insert(file).second) {
            throw Error(lp, fmt::format("lists {} twice", file.filename().string()), "one light for a photograph");
        }
        contents.capture.photographs.push_back(photographOf(file));
    }
    contents.capture.lights = lights.lights;
    contents.capture.lightsSource = lights.lights.empty() ? "" : lp.string();
    std::copy_if(pool[0].begin(), pool[0].end(), std::back_inserter(contents.masks),
                 [&](const fs::path& file) { return isNamedMask(file) && !listed.contains(file); });
    return contents;
}

PicturePool picturesBelow(const fs::path& folder)
{
    PicturePool pool;
    gatherPictures(folder, 0, pool);
    return pool;
}

// The folder above may hold anything: its .lp file counts where it lists a photograph of this folder.
std::optional<LayoutContents> readLpAbove(const fs::path& folder)
{
    for (const fs::path& lp : lpFilesIn(fs::weakly_canonical(folder).parent_path())) {
        const PicturePool pool = picturesBelow(folder);
        const LightFile lights = loadLpList(lp);
        const bool itsOwn =
            std::any_of(lights.photographs.begin(), lights.photographs.end(), [&](const std::string& name) {
                return !findPhotograph(pool, lp, folder, fs::path(withSlashes(name)).filename()).empty();
            });
        if (itsOwn) {
            return readLp(lp, folder, pool);
        }
    }
    return std::nullopt;
}

} // namespace

std::optional<LayoutContents> readRtiLayout(const fs::path& folder, const fs::path& rig)
{
    const std::vector<fs::path> files = lpFilesIn(folder);
    if (files.empty()) {
        return readLpAbove(folder);
    }
    const bool chosen = files.size() > 1 && lowerCase(rig.extension().string()) == ".lp";
    if (files.size() > 1 && !chosen) {
        throw Error(folder,
                    fmt::format("holds {} .lp files, {} and {} among them", files.size(), files[0].filename().string(),
                                files[1].filename().string()),
                    "one, or --rig to choose");
    }
    return readLp(chosen ? rig : files[0], folder, picturesBelow(folder));
}

} // namespace nacre
