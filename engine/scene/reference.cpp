#include "engine/scene/reference.h"

#include <glm/geometric.hpp>

#include "engine/scene/ball.h"
#include "engine/scene/parallel_for.h"
#include "shared/shading.h"

namespace nacre {
namespace {

// `lookups`: horizonLookup of each light.
glm::vec3 radianceUnderLights(const BrdfTable& table, const Scene& scene, std::span<const glm::vec4> lookups,
                              size_t pixel)
{
    const glm::vec3& n = scene.surface.normals.normals[pixel];
    glm::vec3 sum(0);
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        const float nDotL = glm::dot(n, light.direction);
        if (nDotL > 0) {
            const glm::vec3 f = evaluateTable(table, n, light.direction, scene.view).value;
            sum +=
                visibilityOf(scene.surface.horizon, lookups[i], pixel) * radianceFromBrdf(f, light.irradiance, nDotL);
        }
    }
    return sum;
}

glm::vec3 radianceOfPixel(const Scene& scene, std::span<const glm::vec4> lookups, size_t pixel)
{
    const Surface& surface = scene.surface;
    const glm::vec3& n = surface.normals.normals[pixel];
    const uint8_t label = surface.labels[pixel];
    const bool hasNormal = surface.normals.confidence[pixel] > 0;
    const bool hasMaterial = label < surface.materials.size();
    if (!hasNormal || !hasMaterial || glm::dot(n, scene.view) <= 0) {
        return glm::vec3(0);
    }
    const glm::vec3 radiance = radianceUnderLights(surface.materials[label].table, scene, lookups, pixel);
    const float* a = surface.albedo.values.empty() ? nullptr : &surface.albedo.values[3 * pixel];
    return a == nullptr ? radiance : glm::vec3(a[0], a[1], a[2]) * radiance;
}

} // namespace

Frame renderReference(const Scene& scene, int threads)
{
    const NormalMap& normals = scene.surface.normals;
    Frame frame(normals.width, normals.height, 3);
    std::vector<glm::vec4> lookups;
    for (const Light& light : scene.lights) {
        lookups.push_back(horizonLookup(light.direction, scene.surface.horizon.azimuths));
    }
    parallelFor(frame.pixelCount(), 1024, threads, [&](size_t first, size_t last) {
        for (size_t pixel = first; pixel < last; ++pixel) {
            const glm::vec3 radiance = radianceOfPixel(scene, lookups, pixel);
            for (int c = 0; c < 3; ++c) {
                frame.values[3 * pixel + c] = radiance[c];
            }
        }
    });
    return frame;
}

Image referenceBallPicture(const Scene& scene, std::span<const BallSize> sizes, const Display& display, int threads)
{
    const Surface& surface = scene.surface;
    std::vector<Ball> balls;
    for (size_t m = 0; m < surface.materials.size(); ++m) {
        balls.push_back(makeBall(surface.materials[m].table, scene.lights, sizes[m].radiance, threads));
    }
    Frame frame(surface.normals.width, surface.normals.height, 3);
    for (size_t pixel = 0; pixel < frame.pixelCount(); ++pixel) {
        const glm::vec3& n = surface.normals.normals[pixel];
        const uint8_t label = surface.labels[pixel];
        if (surface.normals.confidence[pixel] <= 0 || label >= balls.size() || n.z <= 0) {
            continue;
        }
        const glm::vec3 radiance = sampleStretchedBall(balls[label], sizes[label].display, n);
        const float* a = surface.albedo.values.empty() ? nullptr : &surface.albedo.values[3 * pixel];
        for (int c = 0; c < 3; ++c) {
            frame.values[3 * pixel + c] = a == nullptr ? radiance[c] : a[c] * radiance[c];
        }
    }
    return displayedImage(frame, display);
}

} // namespace nacre
