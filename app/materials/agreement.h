#pragma once
#include <functional>
#include <span>
#include <vector>

#include "engine/lights/light.h"
#include "engine/surface/surface.h"

namespace nacre {

// A small picture's surface, by which is told what an export of it loses.
Surface judgedSurface(const Surface& surface);

// Some of the lights that the surface was captured under, one of ours where there are none.
std::vector<Light> judgedLights(const Surface& surface);

// dB of a surface's pictures against its own from the front, under each of those lights.
double agreementDecibels(const Surface& own, const std::function<Image(std::span<const Light>)>& picture);

} // namespace nacre
