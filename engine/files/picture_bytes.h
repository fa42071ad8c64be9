#pragma once
// What picture readers hide of the files that they read.
#include <filesystem>
#include <optional>

#include "engine/files/transfer_curve.h"

namespace nacre {

// What a PNG's own sRGB or gAMA chunk says of its curve; picture readers add a guess, which hides whether it does.
std::optional<TransferCurve> pngCurve(const std::filesystem::path& file);

// Whether a JPEG's EXIF names Adobe RGB as its colour space: R03 as InteroperabilityIndex (DCF 2.0, 2010).
bool statesAdobeRgb(const std::filesystem::path& file);

// Whether a JPEG reaches its end-of-image marker (ITU-T T.81, 1992, B.1.1.3). libjpeg fills up a file that was cut off
// with grey and only warns, which OpenImageIO does not pass on. What follows the marker, as some cameras append, does
// not count. True for files that are no JPEG.
bool isCompleteJpeg(const std::filesystem::path& file);

} // namespace nacre
