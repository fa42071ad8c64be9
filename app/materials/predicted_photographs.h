#pragma once
#include <filesystem>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/rti/rti_picture.h"

namespace nacre {

// FILE.ptm, FILE.rti of hemispherical harmonics, or a folder with info.json. Throws Error (data).
RtiPicture loadRelightable(const std::filesystem::path& source);

// Directions of white lights that such files mostly know: within 60 degrees of the view.
std::vector<glm::vec3> predictedLights(int count);

// Writes a capture into a folder that exists: what the picture shows under each of the lights, 8 bits and sRGB, and a
// mask of what is not black under all of them. Throws Error where all is; `source` is for its message.
void writePredictedCapture(const std::filesystem::path& folder, const RtiPicture& picture,
                           const std::vector<glm::vec3>& lights, const std::filesystem::path& source, int threads);

} // namespace nacre
