#pragma once
#include <string>
#include <vector>

#include "engine/lights/light.h"

namespace nacre {

// Lights that are on together.
struct LightRig {
    std::string name; // for captions and file names
    std::vector<Light> lights;
};

// One value of --rig: a preset (lightsOfRig); a file of lights as nacre calibrate writes it (.json, .lp), all of them
// or FILE#N the one of photograph N from 1; an environment (.exr, .hdr). Throws Error: usage that lists the presets
// where it is none of these, data where the file cannot be used.
LightRig rigFromArgument(const std::string& text);

} // namespace nacre
