#pragma once
#include <vector>

#include "assets/synth_options.h"
#include "engine/scene/light.h"

namespace nacre {

// A Fibonacci spiral over the cap about the view, each light moved a little and with an irradiance of its own.
std::vector<Light> synthLights(const SynthOptions& options);

} // namespace nacre
