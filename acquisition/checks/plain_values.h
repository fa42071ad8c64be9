#pragma once
// What photographs' values say before any model of the object is asked.
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "acquisition/capture/finding.h"
#include "acquisition/capture/observations.h"
#include "engine/lights/light.h"

namespace nacre {

// Where values end below full scale, as those of 12 bits in 16 do, by channel: more of them are just the largest than
// a little below it, in several photographs. Infinite in channels that merely have a largest; none where all do.
std::optional<glm::vec3> endOfValues(const Observations& sample);

// A warning where much of a mask is dark under every light, which the object is not; or much of a picture without one.
SelfChecks checkMask(const Observations& sample, bool isMasked);

// A warning where a mask of the capture has all of the picture's border and leaves out much in its middle.
SelfChecks checkMaskBorder(const std::vector<uint8_t>& mask, int width, int height);

// A warning where pixels differ between photographs by far less than the directions of the lights make a surface do
// that faces their middle, and which differs less than most.
SelfChecks checkDifferences(const Observations& sample, const std::vector<Light>& lights);

} // namespace nacre
