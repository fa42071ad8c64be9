#include "acquisition/capture/capture_layouts.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "acquisition/capture/picture_files.h"
#include "engine/files/error.h"
#include "engine/files/text_files.h"

namespace nacre {
namespace fs = std::filesystem;

Photograph photographOf(const fs::path& file)
{
    return {file.filename().string(), {Exposure{file}}};
}

// The University of Washington's photometric-stereo sets: NAME.0.tga, NAME.1.tga, ... and NAME.mask.tga. Lights come
// from spheres, or from a file that the user names.

namespace {

constexpr const char* kSphereFolder =
    "one sphere in a folder, as NAME.mask.* and NAME.0.*, NAME.1.*, ..., or as pictures of "
    "which one has \"mask\" in its name, or --circle";

std::vector<Photograph> photographsOf(const std::vector<fs::path>& files)
{
    std::vector<Photograph> photographs;
    std::transform(files.begin(), files.end(), std::back_inserter(photographs), photographOf);
    return photographs;
}

} // namespace

std::optional<LayoutContents> readUwLayout(const fs::path& folder)
{
    const auto pictures = findNumberedPictures(folder);
    if (!pictures) {
        return std::nullopt;
    }
    LayoutContents contents;
    contents.capture.layout = CaptureLayout::uw;
    contents.capture.name = pictures->name;
    contents.capture.photographs = photographsOf(pictures->photographs);
    contents.listing = folder;
    contents.masks = pictures->masks;
    return contents;
}

SpherePhotographs readSphereFolder(const fs::path& folder, const std::optional<Circle>& outline)
{
    if (!fs::is_directory(folder)) {
        throw Error(folder, fs::exists(folder) ? "is no folder" : "does not exist", kSphereFolder);
    }
    std::vector<fs::path> photographs;
    std::vector<fs::path> masks;
    if (const auto numbered = findNumberedPictures(folder); numbered && !numbered->masks.empty()) {
        photographs = numbered->photographs;
        masks = numbered->masks;
    } else {
        for (const fs::path& file : picturesIn(folder)) {
            (isNamedMask(file) ? masks : photographs).push_back(file);
        }
    }
    if ((masks.size() != 1 && !outline) || photographs.empty()) {
        throw Error(folder,
                    fmt::format("holds {} photographs and {} masks of a sphere", photographs.size(), masks.size()),
                    kSphereFolder);
    }
    SpherePhotographs sphere;
    sphere.source = folder;
    sphere.photographs = photographsOf(photographs);
    sphere.circle = outline;
    sphere.maskFile = outline ? fs::path() : masks[0];
    return sphere;
}

// Pictures of any names in natural order, whose lights come from elsewhere.
std::optional<LayoutContents> readPlainFolder(const fs::path& folder)
{
    LayoutContents contents;
    contents.capture.layout = CaptureLayout::pictures;
    contents.listing = folder;
    for (const fs::path& file : picturesIn(folder)) {
        isNamedMask(file) ? contents.masks.push_back(file) : contents.capture.photographs.push_back(photographOf(file));
    }
    return contents.capture.photographs.empty() ? std::nullopt : std::optional(contents);
}

// Shi et al., A Benchmark Dataset and Evaluation for Non-Lambertian and Uncalibrated Photometric Stereo (DiLiGenT),
// 2016: filenames.txt lists the photographs, light_directions.txt their lights in the camera frame (x right, y up,
// z to the camera), light_intensities.txt the lights' RGB irradiances.

namespace {

constexpr const char* kDirectionsFile = "light_directions.txt";
constexpr const char* kIntensitiesFile = "light_intensities.txt";

// The file of that name or, where there is none, the only one whose name is the same to a person.
fs::path findFile(const fs::path& folder, const fs::path& name)
{
    const fs::path exact = folder / name;
    std::vector<fs::path> alike;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(exact.parent_path(), ignored)) {
        if (comparable(entry.path().filename().string()) == comparable(name.filename().string())) {
            alike.push_back(entry.path());
        }
    }
    return !fs::exists(exact) && alike.size() == 1 ? alike[0] : exact;
}

LightFile loadDiligentLights(const fs::path& folder)
{
    LightFile result = loadDirectionTable(findFile(folder, kDirectionsFile));
    if (const fs::path intensities = findFile(folder, kIntensitiesFile); fs::exists(intensities)) {
        addIrradiances(result, intensities);
    }
    return result;
}

} // namespace

std::optional<LayoutContents> readDiligentLayout(const fs::path& folder)
{
    const fs::path listing = findFile(folder, "filenames.txt");
    if (!fs::exists(listing)) {
        return std::nullopt;
    }
    LayoutContents contents;
    contents.capture.layout = CaptureLayout::diligent;
    contents.listing = listing;
    for (const std::string& name : loadTextLines(listing)) {
        const fs::path file = findFile(folder, name);
        if (!fs::exists(file)) {
            throw Error(file, "does not exist", "a photograph, as filenames.txt lists it");
        }
        contents.capture.photographs.push_back(photographOf(file));
    }
    if (const fs::path directions = findFile(folder, kDirectionsFile); fs::exists(directions)) {
        assignLights(contents, loadDiligentLights(folder), directions);
    }
    for (const fs::path& file : picturesIn(folder)) {
        if (lowerCase(file.stem().string()) == "mask") {
            contents.masks.push_back(file);
        }
    }
    for (const char* truth : {"Normal_gt.png", "Normal_gt.mat"}) { // the last one wins: it is not rounded
        if (fs::exists(folder / truth)) {
            contents.capture.truthNormals = folder / truth;
        }
    }
    return contents;
}

// Reflectance transformation imaging: one .lp file, a count and then "file x y z", or names alone, a line, beside its
// photographs or in a folder above them. The names often carry folders of another machine, so photographs are found by
// name.

namespace {

constexpr int kDeepestFolder = 2; // below the .lp file

// Pictures by depth below the .lp file, so that its own folder comes before, say, one of thumbnails.
using PicturePool = std::vector<std::vector<fs::path>>;

void gatherPictures(const fs::path& folder, size_t depth, PicturePool& pool)
{
    std::error_code unreadable; // below the capture's own folder, of which picturesIn tells, nobody's business
    if (fs::directory_iterator(folder, unreadable); unreadable && depth > 0) {
        return;
    }
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

// How many folders right above the files have the same names.
size_t sharedFolders(const fs::path& a, const fs::path& b)
{
    const fs::path above = a.parent_path(), other = b.parent_path();
    const bool isSame =
        !above.filename().empty() && lowerCase(above.filename().string()) == lowerCase(other.filename().string());
    return isSame ? 1 + sharedFolders(above, other) : 0;
}

// The one picture that `agrees` in the highest folder that has any, and of several the one in folders that are named
// as those of `listed`; empty where none does.
template <typename Agrees>
fs::path findInPool(const PicturePool& pool, const fs::path& lp, const fs::path& listed, Agrees agrees)
{
    for (const std::vector<fs::path>& pictures : pool) {
        std::vector<fs::path> found;
        std::copy_if(pictures.begin(), pictures.end(), std::back_inserter(found), agrees);
        std::stable_sort(found.begin(), found.end(), [&](const fs::path& a, const fs::path& b) {
            return sharedFolders(a, listed) > sharedFolders(b, listed);
        });
        if (found.size() > 1 && sharedFolders(found[0], listed) == sharedFolders(found[1], listed)) {
            throw Error(lp,
                        fmt::format("lists a photograph that may be {} or {}", found[0].string(), found[1].string()),
                        "one photograph of that name");
        }
        if (!found.empty()) {
            return found[0];
        }
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
    using Part = std::string (*)(const fs::path&);
    for (const Part part : {Part([](const fs::path& file) { return file.filename().string(); }),
                            Part([](const fs::path& file) { return comparable(file.filename().string()); }),
                            Part([](const fs::path& file) { return comparable(file.stem().string()); })}) {
        fs::path found = findInPool(pool, lp, name, [&](const fs::path& file) { return part(file) == part(name); });
        if (!found.empty()) {
            return found;
        }
    }
    return {};
}

std::vector<fs::path> lpFilesIn(const fs::path& folder)
{
    std::set<fs::path> files;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
        const bool hidden = entry.path().filename().string().starts_with('.');
        if (!hidden && entry.is_regular_file() && lowerExtension(entry.path()) == ".lp") {
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
    contents.capture.lightPlaces = lights.vectors;
    contents.capture.irradianceGiven = lights.irradianceGiven;
    contents.capture.lightsSource = lights.lights.empty() ? "" : lp.string();
    const auto isMaskIn = [&](const fs::path& place) {
        return [&, place](const fs::path& file) {
            return file.parent_path() == place && isNamedMask(file) && !listed.contains(file);
        };
    };
    std::copy_if(pool[0].begin(), pool[0].end(), std::back_inserter(contents.masks), isMaskIn(folder));
    const fs::path photographs = contents.capture.photographs[0].exposures[0].file.parent_path();
    for (size_t depth = 1; depth < pool.size() && contents.masks.empty(); ++depth) {
        std::copy_if(pool[depth].begin(), pool[depth].end(), std::back_inserter(contents.masks), isMaskIn(photographs));
    }
    return contents;
}

PicturePool picturesBelow(const fs::path& folder)
{
    PicturePool pool;
    gatherPictures(folder, 0, pool);
    return pool;
}

// Whether a picture has the name of a listed one, whatever its folder.
bool listsAny(const fs::path& lp, const PicturePool& pool)
{
    std::set<std::string> stems;
    for (const std::vector<fs::path>& pictures : pool) {
        for (const fs::path& file : pictures) {
            stems.insert(comparable(file.stem().string()));
        }
    }
    const LightFile lights = loadLpList(lp);
    return std::any_of(lights.photographs.begin(), lights.photographs.end(), [&](const std::string& name) {
        return stems.contains(comparable(fs::path(withSlashes(name)).stem().string()));
    });
}

// The folder above may hold anything: its .lp file counts where it lists a photograph of this folder.
std::optional<LayoutContents> readLpAbove(const fs::path& folder)
{
    const PicturePool pool = picturesBelow(folder);
    for (const fs::path& lp : lpFilesIn(fs::weakly_canonical(folder).parent_path())) {
        if (listsAny(lp, pool)) {
            return readLp(lp, folder, pool);
        }
    }
    return std::nullopt;
}

// In a project of RTIBuilder the .lp file and the photographs lie in folders side by side.
std::optional<LayoutContents> readProject(const fs::path& folder)
{
    if (!picturesIn(folder).empty()) {
        return std::nullopt;
    }
    std::set<fs::path> lists;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        if (entry.is_directory()) {
            const std::vector<fs::path> here = lpFilesIn(entry.path());
            lists.insert(here.begin(), here.end());
        }
    }
    if (lists.size() > 1) {
        throw Error(folder,
                    fmt::format("holds {} .lp files in its folders, {} and {} among them", lists.size(),
                                lists.begin()->string(), std::next(lists.begin())->string()),
                    "one, or the choice of an .lp as the capture");
    }
    return lists.empty() ? std::nullopt : std::optional(readLp(*lists.begin(), folder, picturesBelow(folder)));
}

// The photographs of an .lp file lie beside or below it; else below the folder above.
LayoutContents readLpOfFolder(const fs::path& lp, const fs::path& folder)
{
    const PicturePool pool = picturesBelow(folder);
    const fs::path above = fs::weakly_canonical(folder).parent_path();
    if (pool[0].empty() && !listsAny(lp, pool)) {
        const PicturePool more = picturesBelow(above);
        if (listsAny(lp, more)) {
            return readLp(lp, above, more);
        }
    }
    return readLp(lp, folder, pool);
}

} // namespace

std::optional<LayoutContents> readRtiLayout(const fs::path& folder, const fs::path& rig)
{
    if (fs::is_regular_file(folder)) {
        const fs::path beside = folder.has_parent_path() ? folder.parent_path() : fs::path(".");
        return readLpOfFolder(folder, beside);
    }
    const std::vector<fs::path> files = lpFilesIn(folder);
    if (files.empty()) {
        std::optional<LayoutContents> above = readLpAbove(folder);
        return above ? above : readProject(folder);
    }
    const bool chosen = files.size() > 1 && lowerCase(rig.extension().string()) == ".lp";
    if (files.size() > 1 && !chosen) {
        throw Error(folder,
                    fmt::format("holds {} .lp files, {} and {} among them", files.size(), files[0].filename().string(),
                                files[1].filename().string()),
                    "one, or the choice of a rig");
    }
    return readLpOfFolder(chosen ? rig : files[0], folder);
}

} // namespace nacre
