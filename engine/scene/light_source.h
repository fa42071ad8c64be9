#pragma once
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "engine/surface/surface.h"

namespace nacre {

inline constexpr int kSoftLights = 64;

// A light as the user names it, before it becomes points.
struct LightSource {
    int captured = 0;              // number of the surface's captured light, from 1; 0: what follows
    glm::vec3 direction{0, 0, 1};  // from the surface towards the light, of any length
    glm::vec3 irradiance{1, 1, 1}; // RGB on a plane that faces the light
    float distance = std::numeric_limits<float>::infinity(); // as Light has it
    float softDegrees = 0; // radius of the cap that it fills, as the object's middle sees it; 0: a point
    bool on = true;
    bool operator==(const LightSource&) const = default;
};

// As command lines and state files have it: "x,y,z" or "x,y,z,r,g,b" (irradiance 1 where it is not given), or
// "captured:N"; "near:WIDTHS:" before the numbers puts it so many widths of the object from the object's middle,
// "soft:DEGREES:" before all that spreads the light as kSoftLights ones, "off:" before that switches it off. Throws
// Error (usage).
LightSource lightSourceFromText(const std::string& text);

// The inverse, exact to the bit.
std::string textOf(const LightSource& source);

// The surface's own for "captured:N". Throws Error (usage) where it has no such light.
Light lightOf(const LightSource& source, std::span<const CapturedLight> captured);

// The points of those that are on, in order.
std::vector<Light> lightsOf(std::span<const LightSource> sources, std::span<const CapturedLight> captured);

// Where none is given: the capture's first light, or one from the upper right of the camera where there is none.
LightSource defaultLightSource(std::span<const CapturedLight> captured);

// Numbers between commas; empty where anything else is there.
std::vector<float> numbersFromText(const std::string& text);

} // namespace nacre
