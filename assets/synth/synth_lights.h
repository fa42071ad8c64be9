#pragma once
#include <vector>

#include "assets/synth/synth_options.h"
#include "engine/lights/light.h"

namespace nacre {

// A Fibonacci spiral over the cap about the view, each light moved a little and with an irradiance of its own.
std::vector<Light> synthLights(const SynthOptions& options);

} // namespace nacre
