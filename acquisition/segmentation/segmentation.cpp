#include "acquisition/segmentation/segmentation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "acquisition/capture/capture_maps.h"
#include "acquisition/segmentation/material_tree.h"
#include "engine/files/error.h"
#include "engine/files/image.h"
#include "engine/files/text_files.h"

namespace nacre {

namespace {

size_t countOf(const std::string& text)
{
    const std::optional<double> number = parseNumber(text);
    const bool whole = number && *number >= 1 && *number <= kMostMaterials && *number == static_cast<int>(*number);
    if (!whole) {
        throw Error("", fmt::format("segmentation auto:{} is not possible", text),
                    fmt::format("auto:N with N from 1 to {}", kMostMaterials), Error::kUsage);
    }
    return static_cast<size_t>(*number);
}

} // namespace

SegmentOptions segmentOptionsFrom(const std::string& text)
{
    if (text.empty()) {
        return {};
    }
    if (text == "none") {
        return {SegmentSource::none, {}, 0};
    }
    if (text == "auto") {
        return {SegmentSource::found, {}, 0};
    }
    if (text.starts_with("auto:")) {
        const size_t count = countOf(text.substr(5));
        return count == 1 ? SegmentOptions{SegmentSource::none, {}, 0}
                          : SegmentOptions{SegmentSource::found, {}, count};
    }
    return {SegmentSource::picture, text, 0};
}

namespace {

constexpr uint32_t kBlack = 0;

// 8 bits a channel; alpha does not count, and a colour picture may hold greys.
uint32_t codeOf(const Image& picture, size_t pixel)
{
    const float* value = &picture.values[pixel * picture.channels];
    const auto code = [](float v) { return static_cast<uint32_t>(std::lround(std::clamp(v, 0.0f, 1.0f) * 255)); };
    return picture.channels < 3 ? code(value[0]) : code(value[0]) << 16 | code(value[1]) << 8 | code(value[2]);
}

std::string nameOfCode(uint32_t code, bool grey)
{
    return grey ? fmt::format("{}", code) : fmt::format("{:06x}", code);
}

// Codes become indices in ascending order; black becomes kUnlabelled.
std::vector<uint8_t> indexed(const std::vector<uint32_t>& codes, std::map<uint32_t, uint8_t>& index,
                             const std::filesystem::path& file)
{
    for (const uint32_t code : codes) {
        if (code != kBlack) {
            index.emplace(code, uint8_t{0});
        }
        if (index.size() > kMostMaterials) {
            throw Error(file, fmt::format("has more than {} different values", kMostMaterials),
                        "labels: one value or colour for each material, black for none, no smooth edges");
        }
    }
    uint8_t next = 0;
    for (auto& [code, number] : index) {
        number = next++;
    }
    std::vector<uint8_t> labels(codes.size(), kUnlabelled);
    for (size_t i = 0; i < codes.size(); ++i) {
        if (codes[i] != kBlack) {
            labels[i] = index.at(codes[i]);
        }
    }
    return labels;
}

// Without the labels that no pixel of the object has; the others keep their order.
void dropUnused(const std::vector<uint8_t>& mask, std::vector<uint8_t>& labels, std::vector<std::string>& names)
{
    std::vector<uint8_t> to(names.size(), kUnlabelled);
    for (size_t i = 0; i < mask.size(); ++i) {
        if (mask[i] && labels[i] != kUnlabelled) {
            to[labels[i]] = 0;
        }
    }
    std::vector<std::string> kept;
    for (size_t label = 0; label < to.size(); ++label) {
        if (to[label] == 0) {
            to[label] = static_cast<uint8_t>(kept.size());
            kept.push_back(names[label]);
        }
    }
    for (uint8_t& label : labels) {
        label = label == kUnlabelled ? kUnlabelled : to[label];
    }
    names = std::move(kept);
}

} // namespace

LabelPicture loadLabelPicture(const std::filesystem::path& file, const Capture& capture)
{
    const Image image = loadImage(file);
    const FileWindow& w = capture.window;
    if (image.width != w.fileWidth || image.height != w.fileHeight) {
        throw Error(file, fmt::format("is {} x {}", image.width, image.height),
                    fmt::format("{} x {} as the photographs", w.fileWidth, w.fileHeight));
    }
    std::vector<uint32_t> codes(image.pixelCount());
    for (size_t i = 0; i < codes.size(); ++i) {
        codes[i] = codeOf(image, i);
    }
    std::map<uint32_t, uint8_t> index;
    LabelPicture picture{windowedLabels(indexed(codes, index, file), capture), {}};
    for (const auto& [code, number] : index) {
        picture.names.push_back(nameOfCode(code, image.channels < 3));
    }
    dropUnused(capture.mask, picture.labels, picture.names);
    if (picture.names.empty()) {
        throw Error(file, "is black on all of the object", "a value or colour for each material");
    }
    return picture;
}

namespace {

constexpr size_t kSmallestPart = 16;
// Shares of the object's pixels: who draws labels means small parts too.
constexpr double kSmallestDrawn = 0.0002, kSmallestFound = 0.003;
constexpr int kMajorityRadius = 2;
constexpr int kMajorityRounds = 2;

LabelGrid gridOf(const Capture& capture)
{
    return {capture.width, capture.height, capture.mask};
}

// A material that lies wholly within the border's width of others keeps all its pixels.
void keepThinMaterials(Segmentation& segmentation)
{
    for (size_t i = 0; i < segmentation.labels.size(); ++i) {
        const uint8_t label = segmentation.labels[i];
        if (label != kUnlabelled && segmentation.regions[label].inner == 0) {
            segmentation.inner[i] = 1;
        }
    }
}

void count(Segmentation& segmentation)
{
    for (size_t i = 0; i < segmentation.labels.size(); ++i) {
        if (segmentation.labels[i] != kUnlabelled) {
            MaterialRegion& region = segmentation.regions[segmentation.labels[i]];
            ++region.pixels;
            region.inner += segmentation.inner[i];
        }
    }
}

Segmentation segmentationOf(std::vector<uint8_t> labels, std::vector<std::string> names, double smallestShare,
                            const Capture& capture)
{
    const LabelGrid grid = gridOf(capture);
    fillUnlabelled(grid, labels);
    const double smallest = smallestShare * static_cast<double>(capture.maskPixels);
    dissolveSmallParts(grid, std::max(kSmallestPart, static_cast<size_t>(smallest)), labels);
    dropUnused(capture.mask, labels, names);
    for (size_t i = 0; i < labels.size(); ++i) { // what no label reaches is of the first material
        labels[i] = !capture.mask[i] ? kUnlabelled : labels[i] == kUnlabelled ? uint8_t{0} : labels[i];
    }
    Segmentation segmentation{std::move(labels), {}, {}, {}};
    for (const std::string& name : names) {
        segmentation.regions.push_back({names.size() > 1 ? capture.name + "-" + name : capture.name, 0, 0});
    }
    segmentation.inner = innerPixels(grid, kBorder, segmentation.labels);
    count(segmentation);
    keepThinMaterials(segmentation);
    for (MaterialRegion& region : segmentation.regions) {
        region.inner = region.inner > 0 ? region.inner : region.pixels;
    }
    return segmentation;
}

} // namespace

Segmentation oneMaterial(const Capture& capture)
{
    Segmentation segmentation{std::vector<uint8_t>(capture.mask.size(), kUnlabelled), capture.mask, {}, {}};
    for (size_t i = 0; i < capture.mask.size(); ++i) {
        segmentation.labels[i] = capture.mask[i] ? uint8_t{0} : kUnlabelled;
    }
    segmentation.regions = {{capture.name, capture.maskPixels, capture.maskPixels}};
    return segmentation;
}

Segmentation segmentationOf(LabelPicture picture, const Capture& capture)
{
    return segmentationOf(std::move(picture.labels), std::move(picture.names), kSmallestDrawn, capture);
}

Segmentation foundSegmentation(const std::vector<PixelTraits>& traits, const Capture& capture,
                               const SegmentOptions& options)
{
    if (options.count > traits.size()) {
        throw Error(capture.folder, fmt::format("has {} pixels that tell their material", traits.size()),
                    fmt::format("as many as the {} materials to find", options.count));
    }
    const FoundMaterials found = findMaterials(traits, options.count);
    std::vector<uint8_t> labels(capture.mask.size(), kUnlabelled);
    for (size_t i = 0; i < traits.size(); ++i) {
        labels[traits[i].pixel] = found.labels[i];
    }
    for (int round = 0; round < kMajorityRounds; ++round) {
        takeMajority(gridOf(capture), kMajorityRadius, labels);
    }
    std::vector<std::string> names;
    for (size_t i = 0; i < found.count; ++i) {
        names.push_back(fmt::format("{}", i + 1));
    }
    Segmentation segmentation = segmentationOf(std::move(labels), std::move(names), kSmallestFound, capture);
    segmentation.source = fmt::format("found in chromaticity, albedo and lobe of {} pixels", traits.size());
    return segmentation;
}

} // namespace nacre
