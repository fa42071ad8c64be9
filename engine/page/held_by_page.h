#pragma once
#include <cstdint>

#include <glm/vec2.hpp>

#include "engine/surface/surface.h"

namespace nacre {

// What a page stores of a surface, as whole numbers: the surface that its reader sees.

// A normal by ball.h's two numbers, 14 bits each: steps of 0.01 degrees. In 16, what a page has most of would be noise.
inline constexpr float kNormalSteps = 8191; // of the code, from 0 to 1
glm::u16vec2 normalCode(const glm::vec3& normal);
glm::vec3 normalFromCode(const glm::u16vec2& code);

// An albedo factor by its square root, in steps of 1/512, or so coarse ones that 16 bits hold them all: a few dark or
// noisy pixels have factors many times the mean's, which is 1.
float albedoStep(const Surface& surface);
uint16_t albedoCode(float factor, float step);
float albedoFromCode(uint16_t code, float step);

// A height by steps of 1/256 pixel, or so coarse ones that 16 bits hold them all: one code of a horizon in twenty moves
// by 1.
struct HeightCodes {
    float low = 0, step = 0; // pixels

    uint16_t of(float height) const;
    float height(uint16_t code) const { return low + step * static_cast<float>(code); }
};
HeightCodes heightCodes(const Surface& surface); // which has a height

// f and its expected error as half floats. Throws Error (data), which names the material, as requireHeld does and where
// a side has more than kMostTexelsAlong texels.
inline constexpr int kMostTexelsAlong = 256; // of a 3D texture, which every browser has
Material heldByPage(Material material);
// Throws where a value is not finite or beyond half floats' largest.
void requireHeld(const Material& material);

// The surface with its normals, factors, height, the horizon of that and materials as stored; labels, residual layer
// and lights are stored as they are.
Surface heldByPage(Surface surface);

} // namespace nacre
