#pragma once
#include <string>

namespace nacre {

struct PictureSize {
    int width = 0; // pixels
    int height = 0;
    bool operator==(const PictureSize&) const = default;
};

// "WIDTHxHEIGHT", both at least 1. Throws Error (usage) that calls it by `name`.
PictureSize sizeFromArgument(const std::string& name, const std::string& text);

} // namespace nacre
