#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/files/image.h"
#include "engine/lights/light.h"

namespace nacre {

// Directional lights that stand for one, where nothing else is asked for.
inline constexpr int kEnvironmentLights = 256;

// Radiance from all directions as a latitude-longitude picture, as OpenEXR's envmaps have it: +y on top, +z (the
// camera's side) in the middle of the width, +x (right of the camera) a quarter of the width to the left of it.
struct Environment {
    Image radiance;        // RGB
    std::string clamped{}; // how many values were no radiance and what became of them; empty where all are
};

// EXR or HDR. What is negative or no number becomes 0, what is infinite the largest value. Throws Error where the
// picture is not twice as wide as high.
Environment loadEnvironment(const std::filesystem::path& file);

// Unit, of the middle of a pixel of a latitude-longitude picture.
glm::dvec3 environmentDirection(const Image& radiance, int x, int y);

// At most `count` lights whose irradiances add up to the environment's: regions are halved, the one of most energy
// first, where each half has half of it (after Debevec, A Median Cut Algorithm for Light Probe Sampling, 2005); a
// region's light stands at its centroid. `turn` radians about +y carry +z towards +x. Black regions give no light, and
// neither does what lies straight behind the surface, where nothing visible sees it.
std::vector<Light> lightsFromEnvironment(const Environment& environment, int count, float turn = 0);

} // namespace nacre
