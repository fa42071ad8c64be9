#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nacre {

// Of a pixel that no label is known of.
inline constexpr uint8_t kUnlabelled = 255;

// Labels of a picture's pixels, row by row. Only pixels of the object (mask != 0) count.
struct LabelGrid {
    int width = 0;
    int height = 0;
    std::span<const uint8_t> mask;
};

// Unlabelled pixels of the object take the label of the nearest labelled one, counted in steps to the eight neighbours
// on the object; what is not connected to any stays.
void fillUnlabelled(const LabelGrid& grid, std::vector<uint8_t>& labels);

// Each pixel takes the label that most of the square of 2 radius + 1 around it have; a tie leaves it as it is.
void takeMajority(const LabelGrid& grid, int radius, std::vector<uint8_t>& labels);

// Connected parts (four neighbours) of fewer pixels than `fewest` go to their neighbours, parts that have none stay.
void dissolveSmallParts(const LabelGrid& grid, size_t fewest, std::vector<uint8_t>& labels);

// Erosion: 1 on pixels of the object in whose square of 2 radius + 1 no pixel of the object has another label. The
// object's outline erodes nothing.
std::vector<uint8_t> innerPixels(const LabelGrid& grid, int radius, const std::vector<uint8_t>& labels);

} // namespace nacre
