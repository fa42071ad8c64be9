#pragma once
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/brdf/brdf_models.h"
#include "engine/brdf/brdf_tabulation.h"
#include "engine/surface/surface.h"

namespace nacre {

// A ring of lights about one from the front, all within 40 degrees of it.
inline std::vector<CapturedLight> capturedRing(int count)
{
    std::vector<CapturedLight> lights = {{"0", Light{}}};
    for (int i = 1; i < count; ++i) {
        const float azimuth = 6.2832f * static_cast<float>(i) / static_cast<float>(count - 1);
        const glm::vec3 direction(std::cos(azimuth), std::sin(azimuth), 1.2f);
        lights.push_back({std::to_string(i), Light{glm::normalize(direction), {1, 1, 1}}});
    }
    return lights;
}

// A layer of `components` with codes and weights of every kind, for a surface that has lights.
inline ResidualLayer anyResidual(const Surface& surface, int components)
{
    ResidualLayer layer;
    layer.width = surface.normals.width;
    layer.height = surface.normals.height;
    layer.components = components;
    layer.trust = 0.5f;
    for (const CapturedLight& light : surface.lights) {
        layer.nodes.push_back(light.light.direction);
    }
    for (int k = 0; k < components; ++k) {
        layer.low.push_back(-0.04f - 0.01f * static_cast<float>(k));
        layer.high.push_back(0.05f);
        for (size_t i = 0; i < layer.nodes.size(); ++i) {
            const float x = static_cast<float>(i) + 3 * static_cast<float>(k);
            layer.weights.emplace_back(std::sin(x), std::cos(1.7f * x), std::sin(2.3f * x + 1));
        }
    }
    layer.codes.resize(layer.layers() * layer.pixelCount() * kComponentsPerTexel);
    for (size_t i = 0; i < layer.codes.size(); ++i) {
        const size_t texel = i / kComponentsPerTexel,
                     component = texel / layer.pixelCount() * kComponentsPerTexel + i % kComponentsPerTexel;
        layer.codes[i] = component < static_cast<size_t>(components) ? static_cast<uint8_t>(i * 2654435761u >> 13) : 0;
    }
    return layer;
}

// An 8x8 cap of a matt sphere with a layer of six components.
inline Surface residualSurface(int size = 8)
{
    NormalMap normals(size, size);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const float half = 0.5f * static_cast<float>(size);
            const glm::vec3 n((static_cast<float>(x) + 0.5f - half) / size,
                              -(static_cast<float>(y) + 0.5f - half) / size, 1);
            normals.normals[normals.index(x, y)] = glm::normalize(n);
            normals.confidence[normals.index(x, y)] = 1;
        }
    }
    const LambertGgx matt{.diffuse = glm::vec3(0.3f), .specular = glm::vec3(0)};
    Surface surface = transferredSurface(normals, Material{"matt", tabulatedBrdf(matt), {}});
    surface.lights = capturedRing(9);
    surface.residual = anyResidual(surface, 6);
    return surface;
}

} // namespace nacre
