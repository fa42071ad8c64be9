#pragma once
// Pictures of known normals and shading, for what explains a whole object by one reflectance.
#include <cmath>
#include <functional>
#include <vector>

#include <glm/geometric.hpp>

#include "acquisition/normals/intensities.h"
#include "engine/lights/light.h"

namespace nacre {

// Lights all over the part of the sky that most rigs reach, 15 to 60 degrees from the camera.
inline std::vector<Light> lightsAround(int count)
{
    std::vector<Light> lights;
    for (int i = 0; i < count; ++i) {
        const float share = (static_cast<float>(i) + 0.5f) / static_cast<float>(count), z = 0.97f - 0.47f * share,
                    phi = 2.39996f * static_cast<float>(i), r = std::sqrt(1 - z * z);
        lights.push_back({glm::vec3(r * std::cos(phi), r * std::sin(phi), z), glm::vec3(1)});
    }
    return lights;
}

using Shading = std::function<float(size_t pixel, const glm::vec3& n, const glm::vec3& l)>;

// A picture of normals, and what lights of irradiance 1 show of it: shading times n.l.
struct ShadedScene {
    std::vector<Light> lights;
    std::vector<glm::vec3> normals;
    Intensities intensities;
};

inline ShadedScene photograph(int width, int height, const std::function<glm::vec3(float x, float y)>& normalAt,
                              const Shading& shading, int lights = 36)
{
    ShadedScene scene{lightsAround(lights), {}, {}};
    std::vector<uint32_t> places;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::vec3 normal = normalAt((2.0f * static_cast<float>(x) + 1) / static_cast<float>(width) - 1,
                                              1 - (2.0f * static_cast<float>(y) + 1) / static_cast<float>(height));
            if (normal.z > 0) {
                scene.normals.push_back(normal);
                places.push_back(static_cast<uint32_t>(y * width + x));
            }
        }
    }
    scene.intensities = makeIntensities(places.size(), scene.lights.size());
    scene.intensities.places = places;
    scene.intensities.width = width;
    for (size_t p = 0; p < places.size(); ++p) {
        for (size_t i = 0; i < scene.lights.size(); ++i) {
            const float cosine = glm::dot(scene.normals[p], scene.lights[i].direction);
            scene.intensities.values[p * scene.intensities.stride + i] =
                cosine > 0 ? cosine * shading(p, scene.normals[p], scene.lights[i].direction) : 0;
        }
    }
    return scene;
}

inline glm::vec3 sphere(float x, float y)
{
    const float z = 1 - x * x - y * y;
    return z > 0.04f ? glm::vec3(x, y, std::sqrt(z)) : glm::vec3(0);
}

inline float gloss(const glm::vec3& n, const glm::vec3& l, float width)
{
    const float cosine = glm::dot(n, glm::normalize(l + glm::vec3(0, 0, 1)));
    return std::exp(-(1 - cosine) / (width * width));
}

} // namespace nacre
