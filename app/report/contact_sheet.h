#pragma once
#include <string>
#include <vector>

#include "engine/files/image.h"

namespace nacre {

// A picture and what is written below it.
struct SheetCell {
    Image picture; // display values in [0,1], 1 or 3 channels
    std::string caption;
};

// Rows of cells of one size on dark grey; pictures are centred. Captions are left out where no font is installed.
Image contactSheet(const std::vector<std::vector<SheetCell>>& rows, int cellWidth, int cellHeight);

} // namespace nacre
