#pragma once
#include <optional>
#include <string>
#include <vector>

namespace nacre {

// One of the pictures that a file holds: an EXR's part, a TIFF's page.
struct PicturePart {
    std::string name; // empty where it has none
    int width = 0;
    int height = 0;
    std::vector<std::string> channels; // an EXR's layers are prefixes: "diffuse.R"
};

struct ChosenPicture {
    size_t part = 0;
    std::vector<int> channels; // among the part's: R, G, B, A of one layer first
};

// The one in colour among those of full size, which is the largest one's; where none has colour, the only one of that
// size. None where several are left, or where layers are and none or several have colour.
std::optional<ChosenPicture> choosePicture(const std::vector<PicturePart>& parts);

// Names, sizes and channels, for messages.
std::string describe(const std::vector<PicturePart>& parts);

} // namespace nacre
