#pragma once
#include <cstdint>
#include <vector>

#include "engine/surface/normal_map.h"

namespace nacre {

// What a light does at a pixel, by its photograph. cast: something else stands in its way. away: the surface faces away
// from it. unknown: too near to tell.
enum class LightState : uint8_t { unknown, lit, cast, away };

// The object under distant lights, seen by a distant camera.
struct LitGrid {
    NormalMap normals;
    std::vector<glm::vec3> lights;  // directions
    std::vector<LightState> states; // [light * pixels + pixel], of pixels that have a normal

    LightState& state(size_t pixel, size_t light) { return states[light * normals.normals.size() + pixel]; }
    LightState state(size_t pixel, size_t light) const { return states[light * normals.normals.size() + pixel]; }
};

// From a pixel's radiance and what its BRDF says that it should be, in grey. `cosine`: n.l.
LightState lightStateOf(float cosine, float seen, float predicted);

} // namespace nacre
