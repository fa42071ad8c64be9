#include "acquisition/capture/capture.h"

#include <algorithm>

#include <fmt/format.h>

#include "acquisition/capture/capture_layouts.h"
#include "acquisition/capture/capture_maps.h"
#include "acquisition/capture/light_search.h"
#include "engine/files/error.h"
#include "engine/files/text_files.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr size_t kFewestPhotographs = 3; // a normal has two degrees of freedom, the albedo is the third
constexpr const char* kLayouts =
    "capture.json; filenames.txt with light_directions.txt (DiLiGenT); one .lp file here or above, beside its "
    "photographs (RTI); photographs NAME.0.*, NAME.1.*, ... with NAME.mask.* (University of Washington); or any "
    "photographs with a list of their lights, --rig or --mirror-sphere";

// A list of photographs by its own name.
std::optional<LayoutContents> readList(const fs::path& file)
{
    const std::string extension = lowerExtension(file);
    return extension == ".json" ? readJsonLayout(file) : extension == ".lp" ? readRtiLayout(file, {}) : std::nullopt;
}

LayoutContents readLayout(const fs::path& folder, const CaptureOptions& options)
{
    auto contents = fs::is_directory(folder) ? readJsonLayout(folder / "capture.json") : readList(folder);
    if (!contents && !fs::is_directory(folder)) {
        throw Error(folder, fs::exists(folder) ? "is no folder" : "does not exist",
                    "the folder of a capture, its .lp or its capture.json");
    }
    if (!contents) {
        contents = readDiligentLayout(folder);
    }
    if (!contents) {
        contents = readRtiLayout(folder, options.rig);
    }
    if (!contents) {
        contents = readUwLayout(folder);
    }
    if (!contents) {
        contents = readPlainFolder(folder);
    }
    if (!contents) {
        throw Error(folder, "holds no capture", kLayouts);
    }
    contents->capture.folder = folder;
    if (contents->capture.name.empty()) {
        const fs::path whole = fs::weakly_canonical(folder);
        contents->capture.name = (fs::is_directory(folder) ? whole : whole.parent_path()).filename().string();
    }
    return *contents;
}

// A mirror sphere that the user names counts for more than directions that a list of photographs came with; where
// irradiances came with them, the lights were measured.
void replaceDirections(Capture& capture)
{
    if (!capture.irradianceGiven) {
        capture.lights.clear();
        capture.lightPlaces.clear();
        capture.lightsSource.clear();
        capture.lightsOrder.clear();
    }
}

void applyOptions(LayoutContents& contents, const CaptureOptions& options)
{
    if (options.offset) {
        contents.offset = options.offset;
    }
    if (!options.mirrorSphere.empty()) {
        contents.capture.mirrorSphere = namedSphere("mirror sphere", options.mirrorSphere, contents, options.circle);
        replaceDirections(contents.capture);
    }
    if (options.circle && options.mirrorSphere.empty()) {
        throw Error("", "--circle is not possible without a mirror sphere", "--mirror-sphere beside it", Error::kUsage);
    }
    if (!options.ambient.empty()) {
        contents.capture.ambient = photographOf(options.ambient);
    }
    if (options.window.width > 0 || options.window.box > 1) {
        contents.capture.window = options.window;
    }
    for (const fs::path& more : options.moreMirrorSpheres) {
        addMirrorSphere(more, contents);
    }
    if (!options.diffuseSphere.empty()) {
        contents.capture.diffuseSphere = namedSphere("diffuse sphere", options.diffuseSphere, contents);
    }
    if (!options.mask.empty()) {
        contents.masks = {options.mask};
    }
    if (!options.smooth.empty()) {
        contents.capture.smoothFile = options.smooth;
    }
    if (contents.masks.size() > 1) {
        throw Error(contents.masks[1], fmt::format("is a mask beside {}", contents.masks[0].filename().string()),
                    "one, or the choice of a mask");
    }
}

void requireSphereCount(const std::optional<SpherePhotographs>& sphere, const LayoutContents& contents)
{
    const size_t expected = contents.capture.photographs.size();
    if (sphere && sphere->photographs.size() != expected) {
        throw Error(sphere->source,
                    fmt::format("has {} photographs of a sphere, {} has {} of the object", sphere->photographs.size(),
                                contents.listing.string(), expected),
                    "one of the sphere for each of the object");
    }
}

void requireCounts(const LayoutContents& contents)
{
    const Capture& capture = contents.capture;
    if (capture.photographs.size() < kFewestPhotographs) {
        throw Error(contents.listing, fmt::format("has {} photographs", capture.photographs.size()),
                    fmt::format("at least {}, each under another light", kFewestPhotographs));
    }
    requireSphereCount(capture.mirrorSphere, contents);
    requireSphereCount(capture.diffuseSphere, contents);
}

void requireLabelSize(const Capture& capture)
{
    if (capture.labelsFile.empty()) {
        return;
    }
    const ImageHeader header = readImageHeader(capture.labelsFile);
    const FileWindow& w = capture.window;
    if (header.width != w.fileWidth || header.height != w.fileHeight) {
        throw Error(capture.labelsFile, fmt::format("is {} x {}", header.width, header.height),
                    fmt::format("{} x {} as the photographs", w.fileWidth, w.fileHeight));
    }
}

// Without one, the alpha of photographs that are cut out, as the first has it; else the whole picture.
void assignMask(LayoutContents& contents)
{
    Capture& capture = contents.capture;
    const bool isGiven = !contents.masks.empty();
    const fs::path& file = isGiven ? contents.masks[0] : capture.photographs[0].exposures[0].file;
    const MaskPicture mask = isGiven ? loadMask(file, capture.window.fileWidth, capture.window.fileHeight)
                                     : MaskPicture{alphaMask(file), true};
    if (mask.inside.empty()) {
        capture.mask.assign(static_cast<size_t>(capture.width) * capture.height, uint8_t{1});
    } else {
        capture.mask = windowedMask(mask.inside, capture, file);
        capture.maskSource = file.filename().string() + (mask.isAlpha ? ", its alpha" : "");
    }
    capture.maskPixels = std::count(capture.mask.begin(), capture.mask.end(), uint8_t{1});
}

// The marks have to leave normals that can be smoothed in, and to mark something.
void loadSmooth(Capture& capture)
{
    if (capture.smoothFile.empty()) {
        return;
    }
    const FileWindow& w = capture.window;
    capture.smooth = windowedMarks(loadMask(capture.smoothFile, w.fileWidth, w.fileHeight).inside, capture);
    size_t marked = 0;
    for (size_t i = 0; i < capture.mask.size(); ++i) {
        marked += capture.smooth[i] && capture.mask[i];
    }
    if (marked == 0 || marked == capture.maskPixels) {
        throw Error(capture.smoothFile, marked == 0 ? "marks nothing of the object" : "marks all of the object",
                    "white on the part of the object whose normals are to be smoothed in from the rest");
    }
}

void requireSphereMask(const std::optional<SpherePhotographs>& sphere)
{
    if (sphere && !sphere->maskFile.empty()) {
        const ImageHeader header = readImageHeader(sphere->photographs[0].exposures[0].file);
        loadMask(sphere->maskFile, header.width, header.height);
    }
}

// The rig that was chosen or, where a capture has no lights and no mirror sphere, lights that are found beside its
// photographs or in their names.
void assignLightsOf(LayoutContents& contents, const CaptureOptions& options)
{
    std::optional<FoundLights> found;
    if (!options.rig.empty()) {
        found = {loadLightFile(options.rig), options.rig};
    } else if (contents.capture.lights.empty() && !contents.capture.mirrorSphere) {
        const bool mayFind = contents.capture.layout != CaptureLayout::json; // which says all itself
        found = mayFind ? searchLights(contents, options.skip.size()) : std::nullopt;
        if (!found && options.needsLights) {
            throw withoutLights(contents);
        }
    }
    skipAndAssignRig(contents, options.skip, found ? std::optional(found->lights) : std::nullopt,
                     found ? found->source : fs::path());
}

} // namespace

std::string describe(CaptureLayout layout)
{
    switch (layout) {
    case CaptureLayout::uw:
        return "University of Washington";
    case CaptureLayout::diligent:
        return "DiLiGenT";
    case CaptureLayout::rti:
        return "RTI";
    case CaptureLayout::pictures:
        return "plain";
    case CaptureLayout::json:
        break;
    }
    return "capture.json";
}

Capture loadCapture(const fs::path& folder, const CaptureOptions& options)
{
    LayoutContents contents = readLayout(folder, options);
    applyOptions(contents, options);
    requireCounts(contents);
    assignLightsOf(contents, options);
    requireCounts(contents);
    placeLights(contents, options);
    examineHeaders(contents, options.transfer);
    Capture& capture = contents.capture;
    requireLabelSize(capture);
    requireSphereMask(capture.mirrorSphere);
    requireSphereMask(capture.diffuseSphere);
    assignMask(contents);
    loadSmooth(capture);
    if (contents.offset) {
        applyOffset(capture, *contents.offset);
    }
    return capture;
}

} // namespace nacre
