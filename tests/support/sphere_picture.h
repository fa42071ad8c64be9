#pragma once
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "acquisition/lights/sphere_outline.h"
#include "engine/files/image.h"

namespace nacre {

inline std::vector<uint8_t> discMask(int width, int height, const Circle& circle)
{
    std::vector<uint8_t> mask(static_cast<size_t>(width) * height, 0);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            mask[static_cast<size_t>(y) * width + x] =
                std::hypot(x + 0.5 - circle.x, y + 0.5 - circle.y) < circle.radius;
        }
    }
    return mask;
}

// A picture of a sphere on black whose pixel is shade(normal), averaged over 4x4 points.
template <class Shade> Image spherePicture(int width, int height, const Circle& circle, Shade&& shade)
{
    Image image(width, height, 3);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            glm::vec3 sum(0);
            for (int s = 0; s < 16; ++s) {
                const int column = s % 4, row = s / 4;
                const glm::vec3 n = sphereNormal(circle, x + (column + 0.5) / 4, y + (row + 0.5) / 4);
                sum += n.z > 0 ? shade(n) : glm::vec3(0);
            }
            image.setRgb(x, y, sum / 16.0f);
        }
    }
    return image;
}

// A distant light's image in a mirror sphere: where the mirrored view meets the light's disc.
inline auto mirrorShade(const glm::vec3& light, float discRadians, float radiance)
{
    return [=](const glm::vec3& n) {
        const glm::vec3 mirrored = 2 * n.z * n - glm::vec3(0, 0, 1);
        return glm::vec3(glm::dot(mirrored, light) > std::cos(discRadians) ? radiance : 0.01f);
    };
}

} // namespace nacre
