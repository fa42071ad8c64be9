#include "acquisition/near_field/as_if_distant.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/files/parallel_for.h"
#include "engine/surface/height_from_normals.h"
#include "engine/surface/object_places.h"

namespace nacre {

namespace {

constexpr size_t kMovedPerTask = 512;
constexpr float kGrazing = 0.05f;
constexpr float kMostBrightened = 5; // by the shading, whatever the normal says

// By what the reference light shades the normal more than the pixel's own; below 0: not known.
float shadingFactor(const glm::vec3& normal, const glm::vec3& reference, const glm::vec3& own)
{
    const float there = glm::dot(normal, reference), here = glm::dot(normal, own);
    if (here >= kGrazing) {
        return std::clamp(there / here, 0.0f, kMostBrightened);
    }
    return there < kGrazing ? 1.0f : -1.0f;
}

void moveLights(const LocalLights& lights, uint32_t pixel, const glm::vec3& normal, std::vector<Light>& own,
                glm::vec3* radiance, uint8_t* saturated)
{
    const std::vector<Light>& reference = lights.reference();
    const std::span<const Light> met = lights.of(pixel, own);
    for (size_t i = 0; i < met.size(); ++i) {
        radiance[i] *= reference[i].irradiance / met[i].irradiance;
        if (normal != glm::vec3(0)) {
            const float factor = shadingFactor(normal, reference[i].direction, met[i].direction);
            radiance[i] *= std::max(factor, 0.0f);
            saturated[i] |= factor < 0;
        }
    }
}

} // namespace

std::vector<glm::vec3> localNormals(const Observations& block, const LocalLights& lights, const NormalMap& normals)
{
    std::vector<glm::vec3> local;
    for (size_t p = 0; p < block.pixels.size() && !normals.normals.empty(); ++p) {
        local.push_back(lights.toLocal(block.pixels[p], normals.normals[block.pixels[p]]));
    }
    return local;
}

Observations asIfDistant(Observations block, const LocalLights& lights, std::span<const glm::vec3> normals, int threads)
{
    if (lights.areDistant()) {
        return block;
    }
    parallelFor(block.pixels.size(), kMovedPerTask, threads, [&](size_t first, size_t last) {
        std::vector<Light> own;
        for (size_t p = first; p < last; ++p) {
            moveLights(lights, block.pixels[p], normals.empty() ? glm::vec3(0) : normals[p], own,
                       &block.radiance[p * block.lightCount], &block.saturated[p * block.lightCount]);
        }
    });
    return block;
}

NormalMap nextGuess(const NormalMap& guess, NormalMap found, const NearField& near)
{
    const size_t pixels = near.lights.empty() ? 0 : guess.normals.size();
    for (size_t i = 0; i < pixels; ++i) {
        const glm::vec3 sum = guess.normals[i] + found.normals[i];
        if (guess.confidence[i] > 0 && found.confidence[i] > 0 && glm::length(sum) > 0) {
            found.normals[i] = glm::normalize(sum);
        }
    }
    return found;
}

// A point is P = C + s r: C the camera at (0, 0, d), r = (u, v, -d) the ray through the plane at (u, v), s = 1 - h / d
// for the height h. Along the surface n.dP = 0, so that d(log s)/du = -n.x / n.r, and likewise v. q = -d log s has the
// slopes dq/du = -n.x / (n.z - (n.x u + n.y v) / d): those of an orthographic surface whose normals are
// (n.x, n.y, n.z - (n.x u + n.y v) / d).
NormalMap withoutLens(NormalMap normals, const NearField& near)
{
    if (std::isinf(near.cameraDistance)) {
        return normals;
    }
    const float distance = static_cast<float>(near.cameraDistance);
    for (int y = 0; y < normals.height; ++y) {
        for (int x = 0; x < normals.width; ++x) {
            glm::vec3& n = normals.normals[normals.index(x, y)];
            const glm::vec2 place(x + 0.5 - near.axis.x, near.axis.y - y - 0.5);
            n.z -= (n.x * place.x + n.y * place.y) / distance;
            n = glm::length(n) > 0 ? glm::normalize(n) : n;
        }
    }
    return normals;
}

Image heightBefore(const NormalMap& normals, const NearField& near, int threads)
{
    IntegrationOptions options;
    options.threads = threads;
    return heightOfIntegral(normals, heightFromNormals(withoutLens(normals, near), options).height, near);
}

Image heightOfIntegral(const NormalMap& normals, Image height, const NearField& near)
{
    const bool hasLens = std::isfinite(near.cameraDistance);
    const float distance = static_cast<float>(near.cameraDistance);
    const float plane = outlineHeight(normals, height);
    for (size_t pixel = 0; pixel < height.values.size(); ++pixel) {
        const float q = normals.confidence[pixel] > 0 ? height.values[pixel] - plane : 0;
        height.values[pixel] = hasLens ? distance * (1 - std::exp(-q / distance)) : q;
    }
    return height;
}

} // namespace nacre
