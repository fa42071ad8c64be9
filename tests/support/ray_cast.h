// Whether a height keeps a light off one of its points, by small steps along the ray in space.
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/files/image.h"

namespace nacre::test {

// All in pixels from the picture's middle, y up; heights from the plane z = 0. `light`: (place, 1) or (direction, 0).
// `camera`: its place; none: distant.
inline bool isHidden(const Image& height, const std::optional<glm::dvec3>& camera, int x, int y,
                     const glm::dvec4& light)
{
    const glm::dvec2 half(height.width / 2.0, height.height / 2.0), axis = camera ? glm::dvec2(*camera) : glm::dvec2(0);
    const double nearness = camera ? 1 / camera->z : 0;
    const double z = height.values[static_cast<size_t>(y) * height.width + x];
    const glm::dvec2 seen(x + 0.5 - half.x, half.y - y - 0.5);
    const glm::dvec3 point(axis + (seen - axis) * (1 - z * nearness), z);
    const glm::dvec3 towards = glm::normalize(glm::dvec3(light) - light.w * point);
    for (double t = 0.75; t < 4 * height.width; t += 0.25) {
        const glm::dvec3 at = point + t * towards;
        const glm::dvec2 pixel = axis + (glm::dvec2(at) - axis) / (1 - at.z * nearness);
        const auto column = static_cast<int>(std::floor(pixel.x + half.x)),
                   row = static_cast<int>(std::floor(half.y - pixel.y));
        if (column < 0 || row < 0 || column >= height.width || row >= height.height || at.z * nearness > 0.9) {
            return false;
        }
        if (height.values[static_cast<size_t>(row) * height.width + column] > at.z + 0.25) {
            return true;
        }
    }
    return false;
}

} // namespace nacre::test
