#pragma once
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/vec4.hpp>

#include "engine/surface/normal_map.h"

namespace nacre {

// What a light does at a pixel, by its photograph. cast: something else stands in its way. away: the surface faces away
// from it. unknown: too near to tell.
enum class LightState : uint8_t { unknown, lit, cast, away };

// The object in the picture's scene (shaders/shared/lens.h), which a distant camera sees: points are (column, -row,
// height) in pixels of the grid.
struct LitGrid {
    // Of the height q, which normals measure; q is the scene's height z itself where the camera is distant, else
    // z = d (exp(q / d) - 1), d its distance (near_field/as_if_distant.cpp).
    NormalMap normals;
    std::vector<glm::vec4> lights;  // a point p sees one in the direction xyz - w p; w = 0 where all see it in the same
    std::vector<LightState> states; // [light * pixels + pixel], of pixels that have a normal
    double cameraDistance = std::numeric_limits<double>::infinity(); // from where heights are 0, in pixels

    LightState& state(size_t pixel, size_t light) { return states[light * normals.normals.size() + pixel]; }
    LightState state(size_t pixel, size_t light) const { return states[light * normals.normals.size() + pixel]; }
};

// Whether heights count from the middle of the outline, because lights or camera are near.
bool isPlaced(const LitGrid& grid);
double sceneHeight(const LitGrid& grid, double q);
double normalsHeight(const LitGrid& grid, double z); // the inverse

// From a pixel's radiance and what its BRDF says that it should be, in grey. `cosine`: n.l.
LightState lightStateOf(float cosine, float seen, float predicted);

} // namespace nacre
