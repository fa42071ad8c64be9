#pragma once
#include <string>

namespace nacre {

struct PictureSize {
    int width = 0; // pixels
    int height = 0;
};

// "WIDTHxHEIGHT", both at least 1. Throws Error (usage) that names the option.
PictureSize sizeFromArgument(const std::string& option, const std::string& text);

} // namespace nacre
