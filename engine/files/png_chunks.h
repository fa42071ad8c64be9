#pragma once
#include <filesystem>

#include "engine/files/image.h"

namespace nacre {

// What a PNG's own sRGB, gAMA or iCCP chunk says of its curve; picture readers add a guess, which hides whether it
// does.
struct PngColour {
    bool declared = false;
    TransferCurve curve = TransferCurve::linear;
};

PngColour readPngColour(const std::filesystem::path& file);

} // namespace nacre
