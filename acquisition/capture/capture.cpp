#include "acquisition/capture/capture.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include "acquisition/capture/capture_layouts.h"
#include "acquisition/capture/capture_offset.h"
#include "acquisition/capture/capture_window.h"
#include "acquisition/capture/picture_files.h"
#include "acquisition/capture/sphere_specification.h"
#include "engine/files/error.h"
#include "engine/files/text_files.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr size_t kFewestPhotographs = 3; // a normal has two degrees of freedom, the albedo is the third
constexpr int kMaskRowsAtOnce = 64;      // few enough for memory, enough to make up for what each call costs
constexpr const char* kLayouts =
    "capture.json; filenames.txt with light_directions.txt (DiLiGenT); one .lp file here or above, beside its "
    "photographs "
    "(RTI); or photographs NAME.0.*, NAME.1.*, ... with NAME.mask.* (University of Washington)";

LayoutContents readLayout(const fs::path& folder, const CaptureOptions& options)
{
    if (!fs::is_directory(folder)) {
        throw Error(folder, fs::exists(folder) ? "is no folder" : "does not exist", "the folder of a capture");
    }
    auto contents = readJsonLayout(folder);
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
        throw Error(folder, "holds no capture", kLayouts);
    }
    contents->capture.folder = folder;
    if (contents->capture.name.empty()) {
        contents->capture.name = fs::weakly_canonical(folder).filename().string();
    }
    return *contents;
}

// A folder's photographs, or the capture's own. A sphere's mask beside the photographs is not the object's.
SpherePhotographs sphereFrom(const char* option, const fs::path& specification, LayoutContents& contents)
{
    const std::optional<SphereInPicture> sphere = sphereInPicture(option, specification);
    if (!sphere) {
        return readSphereFolder(specification);
    }
    std::error_code ignored;
    std::erase_if(contents.masks, [&](const fs::path& mask) { return fs::equivalent(mask, sphere->mask, ignored); });
    return photographsOfSphere(*sphere, contents.capture);
}

// A mirror sphere that the user names counts for more than directions that a list of photographs came with; where
// irradiances came with them, the lights were measured.
void replaceDirections(Capture& capture)
{
    if (!capture.irradianceGiven) {
        capture.lights.clear();
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
        contents.capture.mirrorSphere = sphereFrom("--mirror-sphere", options.mirrorSphere, contents);
        replaceDirections(contents.capture);
    }
    if (!options.diffuseSphere.empty()) {
        contents.capture.diffuseSphere = sphereFrom("--diffuse-sphere", options.diffuseSphere, contents);
    }
    if (!options.mask.empty()) {
        contents.masks = {options.mask};
    }
    if (!options.smooth.empty()) {
        contents.capture.smoothFile = options.smooth;
    }
    if (contents.masks.size() > 1) {
        throw Error(contents.masks[1], fmt::format("is a mask beside {}", contents.masks[0].filename().string()),
                    "one, or --mask to choose");
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

bool isNamed(const Photograph& photograph, const std::string& name)
{
    const std::string own = lowerCase(photograph.name);
    return lowerCase(name) == own || lowerCase(name) == fs::path(own).stem().string();
}

void markSkipped(std::vector<Photograph>& photographs, const std::vector<std::string>& names)
{
    for (const std::string& name : names) {
        size_t found = 0;
        for (Photograph& photograph : photographs) {
            if (isNamed(photograph, name)) {
                photograph.skip = true;
                ++found;
            }
        }
        if (found != 1) {
            throw Error("", fmt::format("--skip {} names {} photographs", name, found),
                        fmt::format("one, such as {}", photographs[0].name), Error::kUsage);
        }
    }
}

// Keeps what stands where nothing is skipped; `list` is empty or as long as `photographs`.
template <class Item> void keepUnskipped(std::vector<Item>& list, const std::vector<Photograph>& photographs)
{
    std::vector<Item> kept;
    for (size_t i = 0; i < list.size(); ++i) {
        if (!photographs[i].skip) {
            kept.push_back(std::move(list[i]));
        }
    }
    list = std::move(kept);
}

void dropSkipped(Capture& capture)
{
    const std::vector<Photograph> photographs = capture.photographs;
    for (const Photograph& photograph : photographs) {
        if (photograph.skip) {
            capture.skipped.push_back(photograph.name);
        }
    }
    keepUnskipped(capture.photographs, photographs);
    keepUnskipped(capture.lights, photographs);
    for (auto* sphere : {&capture.mirrorSphere, &capture.diffuseSphere}) {
        if (*sphere) {
            keepUnskipped((*sphere)->photographs, photographs);
        }
    }
}

// A rig may have the lights of all photographs, or of those that are not skipped.
void skipAndAssignRig(LayoutContents& contents, const CaptureOptions& options)
{
    markSkipped(contents.capture.photographs, options.skip);
    if (options.rig.empty()) {
        dropSkipped(contents.capture);
        return;
    }
    const LightFile rig = loadLightFile(options.rig);
    if (rig.lights.size() == contents.capture.photographs.size()) {
        assignLights(contents, rig, options.rig);
        dropSkipped(contents.capture);
    } else {
        dropSkipped(contents.capture);
        assignLights(contents, rig, options.rig);
    }
}

void applyOffset(Capture& capture, const OffsetChoice& choice)
{
    if (!choice.automatic) {
        capture.offset = choice.value;
        capture.offsetSource = choice.value > 0 ? "given" : "";
        return;
    }
    const OffsetEstimate estimate = estimateOffset(capture);
    capture.offset = estimate.value;
    capture.offsetSource = estimate.reason;
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

// The marks have to leave normals that can be smoothed in, and to mark something.
void loadSmooth(Capture& capture)
{
    if (capture.smoothFile.empty()) {
        return;
    }
    const FileWindow& w = capture.window;
    capture.smooth = windowedMarks(loadMask(capture.smoothFile, w.fileWidth, w.fileHeight), capture);
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

// Names agree without folders, which may be another machine's, extension and case.
std::string comparedName(std::string name)
{
    std::replace(name.begin(), name.end(), '\\', '/');
    return lowerCase(fs::path(name).stem().string());
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
    case CaptureLayout::json:
        break;
    }
    return "capture.json";
}

Photograph photographOf(const fs::path& file)
{
    return {file.filename().string(), {Exposure{file}}};
}

std::vector<size_t> lightsByName(const LightFile& lights, const std::vector<Photograph>& photographs,
                                 const fs::path& file)
{
    std::map<std::string, size_t> lightOf;
    for (size_t i = 0; i < lights.photographs.size(); ++i) {
        lightOf.emplace(comparedName(lights.photographs[i]), i);
    }
    std::vector<size_t> order;
    const Photograph* unnamed = nullptr;
    for (const Photograph& photograph : photographs) {
        const auto named = lightOf.find(comparedName(photograph.name));
        if (named != lightOf.end()) {
            order.push_back(named->second);
        } else if (!unnamed) {
            unnamed = &photograph;
        }
    }
    const bool repeated = std::set(order.begin(), order.end()).size() != order.size();
    if (repeated || lightOf.size() != lights.photographs.size()) {
        return {};
    }
    if (unnamed && !order.empty()) {
        throw Error(
            file,
            fmt::format("names {} of {} photographs, but not {}", order.size(), photographs.size(), unnamed->name),
            "a light for each photograph");
    }
    return order;
}

void assignLights(LayoutContents& contents, const LightFile& lights, const fs::path& file)
{
    Capture& capture = contents.capture;
    if (lights.lights.size() != capture.photographs.size()) {
        throw Error(file,
                    fmt::format("has {} lights, {} has {} photographs", lights.lights.size(), contents.listing.string(),
                                capture.photographs.size()),
                    "one light for each photograph");
    }
    std::vector<size_t> order = lightsByName(lights, capture.photographs, file);
    capture.lightsOrder = order.empty() ? "matched to the photographs by order" : "matched to the photographs by name";
    if (order.empty()) {
        order.resize(lights.lights.size());
        std::iota(order.begin(), order.end(), size_t{0});
    }
    capture.lights.clear();
    std::transform(order.begin(), order.end(), std::back_inserter(capture.lights),
                   [&](size_t index) { return lights.lights[index]; });
    capture.lightsSource = file.string();
    capture.irradianceGiven = lights.irradianceGiven;
}

std::vector<uint8_t> loadMask(const fs::path& file, int width, int height)
{
    // Masks hold shape, not light: no curve. By rows, since a mask is as large as its photographs.
    ImageRows rows(file, TransferCurve::linear);
    const ImageHeader& header = rows.header();
    if (width != 0 && (header.width != width || header.height != height)) {
        throw Error(file, fmt::format("is {} x {}", header.width, header.height),
                    fmt::format("{} x {} as the photographs", width, height));
    }
    const int channels = rows.channels();
    std::vector<uint8_t> mask;
    mask.reserve(static_cast<size_t>(header.width) * header.height);
    std::vector<float> values;
    for (int y = 0; y < header.height; y += kMaskRowsAtOnce) {
        const int last = std::min(y + kMaskRowsAtOnce, header.height);
        values.resize(static_cast<size_t>(last - y) * header.width * channels);
        rows.read(y, last, values);
        for (auto pixel = values.begin(); pixel != values.end(); pixel += channels) {
            mask.push_back(*std::max_element(pixel, pixel + channels) > 0.5f ? 1 : 0);
        }
    }
    if (std::find(mask.begin(), mask.end(), uint8_t{1}) == mask.end()) {
        throw Error(file, "is an empty mask", "the object brighter than one half");
    }
    return mask;
}

Capture loadCapture(const fs::path& folder, const CaptureOptions& options)
{
    LayoutContents contents = readLayout(folder, options);
    applyOptions(contents, options);
    requireCounts(contents);
    skipAndAssignRig(contents, options);
    requireCounts(contents);
    examineHeaders(contents, options.transfer);
    Capture& capture = contents.capture;
    requireLabelSize(capture);
    requireSphereMask(capture.mirrorSphere);
    requireSphereMask(capture.diffuseSphere);
    const FileWindow& window = capture.window;
    capture.mask = contents.masks.empty()
                       ? std::vector<uint8_t>(static_cast<size_t>(capture.width) * capture.height, uint8_t{1})
                       : windowedMask(loadMask(contents.masks[0], window.fileWidth, window.fileHeight), capture,
                                      contents.masks[0]);
    capture.maskPixels = std::count(capture.mask.begin(), capture.mask.end(), uint8_t{1});
    loadSmooth(capture);
    if (contents.offset) {
        applyOffset(capture, *contents.offset);
    }
    return capture;
}

} // namespace nacre
