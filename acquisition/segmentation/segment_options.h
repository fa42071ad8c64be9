#pragma once
#include <cstddef>
#include <filesystem>
#include <string>

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

} // namespace nacre
