#pragma once
#include "acquisition/capture/capture_layouts.h"
#include "engine/files/error.h"

namespace nacre {

// Lights that neither an option nor the layout's own list gives.
struct FoundLights {
    LightFile lights;
    std::filesystem::path source; // for the user
};

// A list of as many directions as there are photographs, or as are not to be skipped, beside them; else directions in
// all of their names: X_Y_Z at the end, a unit vector with decimal points; theta30_phi045 (or tl, pl): degrees from
// the camera and from x to y; A+035E+40: degrees to the right and up, as the Yale face database has them. Throws Error
// where several lists fit.
std::optional<FoundLights> searchLights(const LayoutContents& contents, size_t skipped);

// What a capture without lights holds, and what can be done, in three lines.
Error withoutLights(const LayoutContents& contents);

} // namespace nacre
