#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nacre {

// "9" before "10": runs of digits compare as numbers, letters without regard to case.
bool naturalLess(std::string_view a, std::string_view b);

// By its extension, any kind that OpenImageIO reads.
bool hasPictureExtension(const std::filesystem::path& file);

// A picture with "mask" in its stem.
bool isNamedMask(const std::filesystem::path& file);

// The pictures right in a folder, in natural order of their names.
std::vector<std::filesystem::path> picturesIn(const std::filesystem::path& folder);

// The University of Washington's naming: NAME.0.EXT, NAME.1.EXT, ... and NAME.mask.EXT.
struct NumberedPictures {
    std::string name;
    std::vector<std::filesystem::path> photographs; // in the order of their numbers
    std::vector<std::filesystem::path> masks;
};

// Empty where no picture is numbered, or several names are and none has a mask: numbers may be anything's. Of several
// names those with a mask count. Throws Error where two photographs share a number, or where several names remain.
std::optional<NumberedPictures> findNumberedPictures(const std::filesystem::path& folder);

} // namespace nacre
