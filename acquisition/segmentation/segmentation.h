#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "acquisition/capture/capture.h"
#include "acquisition/segmentation/label_picture.h"
#include "acquisition/segmentation/pixel_traits.h"
#include "acquisition/segmentation/segment_options.h"

namespace nacre {

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
