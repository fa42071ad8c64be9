#pragma once
#include <span>
#include <vector>

#include "engine/lights/light.h"

namespace nacre {

// A light of some size: `count` directional ones of equal irradiance, spread evenly over the cap of `radius` radians
// around its direction. Their sum has the light's irradiance, up to the cosines to its direction.
std::vector<Light> softLight(const Light& light, float radius, int count);

// How lights move over a sequence. turntable: once around the viewing axis. sweep: about the vertical axis, from the
// left to the right by kSweepReach either side of where they are. object: they stay, and a mesh turns once around its
// vertical axis; a relief, whose back is not known, sways about it.
enum class LightMotion { none, turntable, sweep, object };

inline constexpr float kSweepReach = 1.0472f; // radians: 60 degrees

// The lights of frame `frame` of `frames`.
std::vector<Light> movedLights(std::span<const Light> lights, LightMotion motion, int frame, int frames);

} // namespace nacre
