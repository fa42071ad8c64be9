#include "engine/scene/reference.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/files/parallel_for.h"
#include "engine/scene/ball.h"
#include "engine/scene/pixel_lights.h"
#include "shared/shading.h"

namespace nacre {
namespace {

// A scene's lights, once for all pixels.
struct PreparedLights {
    ResidualFrame residual;
    PixelLights met;
};

PreparedLights prepare(const Scene& scene)
{
    const ResidualUse use = isFromTheFront(scene.view) ? ResidualUse::on : ResidualUse::off;
    ResidualFrame residual = residualFrame(scene.surface.residual, scene.lights, use);
    const std::span<const Light> base = residual.base; // stays where it is as the frame moves
    return {std::move(residual), PixelLights(scene.surface, base, scene.view)};
}

// What the BRDF says, and what it does not know.
glm::vec3 withResidual(const Scene& scene, const ResidualFrame& residual, glm::vec3 radiance, size_t pixel)
{
    if (scene.surface.residual.empty() || !isFromTheFront(scene.view)) {
        return radiance;
    }
    return glm::max(radiance + residualOfPixel(scene.surface.residual, residual.weights, pixel), glm::vec3(0));
}

glm::vec3 radianceOfPixel(const Scene& scene, const PreparedLights& lights, size_t pixel)
{
    const Surface& surface = scene.surface;
    if (!isShaded(surface, pixel)) {
        return glm::vec3(0);
    }
    const glm::vec3 view = lights.met.view(pixel);
    if (glm::dot(surface.normals.normals[pixel], view) <= 0) {
        return glm::vec3(0);
    }
    glm::vec3 sum(0);
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const PixelLights::Met met = lights.met.at(i, pixel);
        sum += met.share * brdfRadiance(surface, pixel, met.light, view);
    }
    return withResidual(scene, lights.residual, sum, pixel);
}

} // namespace

glm::vec3 brdfRadiance(const Surface& surface, size_t pixel, const Light& light, const glm::vec3& view)
{
    const glm::vec3& n = surface.normals.normals[pixel];
    const float nDotL = glm::dot(n, light.direction);
    if (nDotL <= 0 || glm::dot(n, view) <= 0) {
        return glm::vec3(0);
    }
    const BrdfTable& table = surface.materials[surface.labels[pixel]].table;
    const glm::vec3 f = evaluateTable(table, n, light.direction, view).value;
    return albedoFactor(surface, pixel) * radianceFromBrdf(f, light.irradiance, nDotL);
}

Frame renderReference(const Scene& scene, int threads)
{
    const NormalMap& normals = scene.surface.normals;
    Frame frame(normals.width, normals.height, 3);
    const PreparedLights lights = prepare(scene);
    parallelFor(frame.pixelCount(), 1024, threads, [&](size_t first, size_t last) {
        for (size_t pixel = first; pixel < last; ++pixel) {
            const glm::vec3 radiance = radianceOfPixel(scene, lights, pixel);
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
    const PreparedLights lights = prepare(scene);
    std::vector<Ball> balls;
    for (size_t m = 0; m < surface.materials.size(); ++m) {
        balls.push_back(makeBall(surface.materials[m].table, lights.residual.base, sizes[m].radiance, threads));
    }
    Frame frame(surface.normals.width, surface.normals.height, 3);
    for (size_t pixel = 0; pixel < frame.pixelCount(); ++pixel) {
        const glm::vec3& n = surface.normals.normals[pixel];
        const uint8_t label = surface.labels[pixel];
        if (!isShaded(surface, pixel) || n.z <= 0) {
            continue;
        }
        const glm::vec3 radiance =
            albedoFactor(surface, pixel) * sampleStretchedBall(balls[label], sizes[label].display, n);
        const glm::vec3 all = withResidual(scene, lights.residual, radiance, pixel);
        std::copy_n(&all.x, 3, &frame.values[3 * pixel]);
    }
    return displayedImage(frame, display);
}

} // namespace nacre
