#pragma once
#include <string>
#include <vector>

#include "engine/scene/surface.h"

namespace nacre {

inline constexpr int kSoftLights = 64;

// Numbers between commas; empty where anything else is there.
std::vector<float> numbersFromArgument(const std::string& text);

// One value of --light: "x,y,z" or "x,y,z,r,g,b", a direction towards the light of any length and an irradiance (1
// where it is not given), or "captured:N", the N-th light of the surface's capture counted from 1. Throws Error
// (usage).
Light lightFromArgument(const std::string& text, const std::vector<CapturedLight>& captured);

// All of them in order; "soft:DEGREES:" before one spreads it over a cap of that radius, as kSoftLights directional
// ones. None given: the capture's first light, or one from the upper right of the camera where the surface has none.
std::vector<Light> lightsFromArguments(const std::vector<std::string>& texts,
                                       const std::vector<CapturedLight>& captured);

} // namespace nacre
