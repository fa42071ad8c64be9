// The University of Washington's photometric-stereo sets: NAME.0.tga, NAME.1.tga, ... and NAME.mask.tga. Lights come
// from spheres, or from a file that the user names.
#include <algorithm>

#include <fmt/format.h>

#include "acquisition/capture/capture_layouts.h"
#include "acquisition/capture/picture_files.h"
#include "engine/files/error.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr const char* kSphereFolder =
    "one sphere in a folder, as NAME.mask.* and NAME.0.*, NAME.1.*, ..., or as pictures of "
    "which one has \"mask\" in its name";

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

SpherePhotographs readSphereFolder(const fs::path& folder)
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
    if (masks.size() != 1 || photographs.empty()) {
        throw Error(folder,
                    fmt::format("holds {} photographs and {} masks of a sphere", photographs.size(), masks.size()),
                    kSphereFolder);
    }
    SpherePhotographs sphere;
    sphere.source = folder;
    sphere.photographs = photographsOf(photographs);
    sphere.maskFile = masks[0];
    return sphere;
}

} // namespace nacre
