#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "acquisition/capture/capture.h"
#include "acquisition/segmentation/label_regions.h"
#include "acquisition/segmentation/pixel_traits.h"

namespace nacre {

// Where an object's materials come from. asCaptured: the labels that the capture has, else one material.
enum class SegmentSource { asCaptured, none, picture, found };

// More labels than this are no labels but a photograph.
inline constexpr size_t kMostMaterials = 64;

struct SegmentOptions {
    SegmentSource source = SegmentSource::asCaptured;
    std::filesystem::path picture; // of the photographs' size
    size_t count = 0;              // of materials to find; 0: as many as the data show
};

// "none", "auto", "auto:N", a file, or nothing for asCaptured. Throws Error (usage).
SegmentOptions segmentOptionsFrom(const std::string& text);

// A picture in which every value or colour is a material, black none.
struct LabelPicture {
    std::vector<uint8_t> labels;    // of the capture's pixels: index into names, or kUnlabelled
    std::vector<std::string> names; // the values of 8 bits ("85"), or colours ("ff0080"), ascending
};

// Throws Error, naming the file: another size than the photographs', no label on the object, more than
// kMostMaterials values. Values that stand beside the object alone are dropped.
LabelPicture loadLabelPicture(const std::filesystem::path& file, const Capture& capture);

struct MaterialRegion {
    std::string name;
    size_t pixels = 0; // of the object
    size_t inner = 0;  // of these, not at a border with another material
};

// Which pixel of an object is of which material. Pixels at the borders between materials may show both: they have the
// label of the nearest one, and no BRDF is sampled from them.
struct Segmentation {
    std::vector<uint8_t> labels; // index into regions; kUnlabelled beside the object
    std::vector<uint8_t> inner;  // 1 where the BRDF may be sampled
    std::vector<MaterialRegion> regions;
    std::string source; // for the user; empty for one material that nobody asked about
};

// Pixels nearer than this to another material are border: a picture's own blur, and the lens's.
constexpr int kBorder = 2;

Segmentation oneMaterial(const Capture& capture);
// Parts of fewer than 16 pixels go to their neighbours; so do parts below 0.02 % of the object, of labels that are
// found 0.3 %.
Segmentation segmentationOf(LabelPicture picture, const Capture& capture);
// Throws Error where options.count exceeds the pixels that tell.
Segmentation foundSegmentation(const std::vector<PixelTraits>& traits, const Capture& capture,
                               const SegmentOptions& options);

} // namespace nacre
