#pragma once
#include <filesystem>

#include "engine/rti/rti_picture.h"

namespace nacre {

// A .rti of hemispherical harmonics as RTIBuilder and `relight` write them: comments from #, a line "3", width, height
// and 3 channels, the number of terms, basis type 2 and 1 byte a coefficient; a scale, then a bias as floats for each
// term; then, from the top left pixel, each channel's coefficients, byte / 255 scale + bias. Terms are those of
// hemisphericalHarmonics; 1, 4 and 9 are read. Throws Error (data) on what is cut off, too long or something else.
RtiPicture loadHsh(const std::filesystem::path& file);

} // namespace nacre
