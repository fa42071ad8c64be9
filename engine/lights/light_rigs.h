#pragma once
#include <string>
#include <vector>

#include "engine/lights/environment.h"
#include "engine/lights/light.h"

namespace nacre {

// Lights that show a shape or a material, by a name:
//   key          one from the upper left, 38 degrees off the view: as far as most captures' lights go
//   three-point  a warm key, a weak cool fill from the other side, a rim from the upper right, nearly from the side
//   raking       one that grazes from the left, 78 degrees off the view: every bump shows
//   ring         16 alike all around the camera, 40 degrees off the view
//   environment  studioEnvironment as directional lights
// The camera sees the front of every one of them. Throws Error (usage) that lists the names.
std::vector<Light> lightsOfRig(const std::string& name);

std::vector<std::string> rigNames();

// A grey room, lighter above than below, with soft boxes to the left, to the right and overhead.
Environment studioEnvironment();

} // namespace nacre
