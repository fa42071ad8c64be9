#pragma once
#include <string>
#include <vector>

#include "engine/scene/light_source.h"

namespace nacre {

// The lights of all values of --light in order (see lightSourceFromText); none given: defaultLightSource. Throws Error
// (usage).
std::vector<Light> lightsFromArguments(const std::vector<std::string>& texts,
                                       const std::vector<CapturedLight>& captured);

} // namespace nacre
