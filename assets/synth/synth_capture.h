#pragma once
#include <filesystem>

#include "assets/synth/synth_scene.h"

namespace nacre {

// Writes the folder of docs/formats.md: capture.json, photographs and masks of the object and of both spheres, and in
// truth/ the normals, the lights, the BRDF and the one radiance scale. Whole or not at all; an existing capture is
// refused without `replace`, and a folder that is no capture is never replaced.
void writeSynthCapture(const std::filesystem::path& folder, const SynthScene& scene, bool replace);

} // namespace nacre
