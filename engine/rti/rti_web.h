#pragma once
#include <filesystem>
#include <span>

#include "engine/rti/rti_picture.h"

namespace nacre {

// The layout that CNR-ISTI's `relight` writes and OpenLIME and relight.js show: info.json and plane_0.jpg,
// plane_1.jpg, ..., a term each, RGB as the terms' channels. A term is (v - bias) scale of the decoded v in [0, 1],
// scale and bias listed by term, then channel (docs/formats.md).

// Into a folder that exists. `lights`, those of the fit, are written for information.
void saveRtiWeb(const std::filesystem::path& folder, const RtiPicture& picture, std::span<const glm::vec3> lights);

// What a viewer sees, JPEG's losses included. Types ptm and hsh, colour space rgb; throws Error (data) on others.
RtiPicture loadRtiWeb(const std::filesystem::path& folder);

} // namespace nacre
