#pragma once
#include <span>

#include "engine/brdf/brdf_table.h"
#include "engine/files/image.h"
#include "engine/lights/light.h"

namespace nacre {

// The reference ball: a material under distant lights, seen from v = (0,0,1), as radiance over the disc of normals on
// the grid of shaders/shared/ball.h. With the view fixed, it answers every pixel of any surface of that material.
struct Ball {
    Image radiance; // size x size, RGB; beyond the rim the rim's values, so that filtering reads no black
};

// All lights collapsed, size x size texels (size >= 2).
Ball makeBall(const BrdfTable& table, std::span<const Light> lights, int size, int threads = 0);

// Bilinear, for a unit normal with z >= 0.
glm::vec3 sampleBall(const Ball& ball, const glm::vec3& normal);

// What the ball path of the renderer has for the normal: the nearest texel of the ball stretched (bilinearly) to
// `displaySize` texels across.
glm::vec3 sampleStretchedBall(const Ball& ball, int displaySize, const glm::vec3& normal);

} // namespace nacre
