#include "acquisition/segmentation/segmentation.h"

#include <algorithm>

#include <fmt/format.h>

#include "acquisition/segmentation/label_regions.h"
#include "acquisition/segmentation/material_tree.h"
#include "engine/files/error.h"

namespace nacre {

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

// Labels without gaps in their numbers, their names alike. What no label reaches is of the first material.
void compact(const Capture& capture, std::vector<uint8_t>& labels, std::vector<std::string>& names)
{
    std::vector<size_t> pixels(names.size(), 0);
    for (size_t i = 0; i < labels.size(); ++i) {
        if (capture.mask[i] && labels[i] != kUnlabelled) {
            ++pixels[labels[i]];
        }
    }
    std::vector<uint8_t> to(names.size(), 0);
    std::vector<std::string> kept;
    for (size_t label = 0; label < names.size(); ++label) {
        to[label] = static_cast<uint8_t>(kept.size());
        if (pixels[label] > 0) {
            kept.push_back(names[label]);
        }
    }
    for (size_t i = 0; i < labels.size(); ++i) {
        labels[i] = !capture.mask[i] ? kUnlabelled : labels[i] == kUnlabelled ? uint8_t{0} : to[labels[i]];
    }
    names = std::move(kept);
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
    compact(capture, labels, names);
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
                    fmt::format("as many as the {} materials of --segment auto:{}", options.count, options.count));
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
