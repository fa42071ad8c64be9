#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "acquisition/capture/capture.h"

namespace nacre {

// Of a pixel that no label is known of.
inline constexpr uint8_t kUnlabelled = 255;

// A picture in which every value or colour is a material, black none.
struct LabelPicture {
    std::vector<uint8_t> labels;    // of the capture's pixels: index into names, or kUnlabelled
    std::vector<std::string> names; // the values of 8 bits ("85"), or colours ("ff0080"), ascending
};

// Throws Error, naming the file: another size than the photographs', no label on the object, more than
// kMostMaterials values. Values that stand beside the object alone are dropped.
LabelPicture loadLabelPicture(const std::filesystem::path& file, const Capture& capture);

} // namespace nacre
