#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "engine/surface/surface.h"

namespace nacre {

// nacre export --ptm and --rti-web: a surface as reflectance transformation images.
struct RtiExport {
    std::filesystem::path ptm, web; // a file, a folder; empty: not asked for
    std::string ptmFormat = "lrgb"; // or rgb
    std::string basis = "hsh";      // of web; or ptm
    int lights = 64;                // virtual ones of the fits
    std::optional<float> exposure;  // stops; as RtiFitOptions has it
    int threads = 0;
    bool force = false;
    bool quiet = false;

    bool isAsked() const { return !ptm.empty() || !web.empty(); }
    // Throws usage Errors.
    void check() const;
};

// Both at once, so that each light's picture is made once. Nothing where nothing is asked for.
void exportRti(const RtiExport& asked, const Surface& surface);

} // namespace nacre
