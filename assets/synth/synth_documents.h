#pragma once
#include <string>

#include "assets/synth/synth_scene.h"

namespace nacre {

// The JSON files of a synthetic capture (docs/formats.md), as text.
std::string captureDocument(const SynthScene& scene);
std::string lightsDocument(const SynthScene& scene);
std::string brdfDocument(const SynthScene& scene);

} // namespace nacre
