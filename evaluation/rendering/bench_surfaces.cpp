#include "evaluation/rendering/bench_surfaces.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace nacre {

namespace {

// Normals in every pixel, in waves: neighbours differ as on a real surface.
NormalMap wavyNormals(int width, int height)
{
    NormalMap map(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float slopeX = 1.3f * std::sin(0.021f * x + 2 * std::sin(0.003f * y));
            const float slopeY = 1.3f * std::sin(0.017f * y);
            map.normals[map.index(x, y)] = glm::normalize(glm::vec3(slopeX, slopeY, 1));
            map.confidence[map.index(x, y)] = 1;
        }
    }
    return map;
}

// Multiplicative hashing (Knuth, The Art of Computer Programming, volume 3, 1998, section 6.4).
uint32_t hashed(uint64_t value)
{
    return static_cast<uint32_t>(value * 0x9E3779B97F4A7C15u >> 32);
}

} // namespace

Image wavyHeight(int width, int height)
{
    Image waves(width, height, 1);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            waves.at(x, y) = 62 * std::cos(0.021f * x + 2 * std::sin(0.003f * y)) - 76 * std::cos(0.017f * y);
        }
    }
    return waves;
}

Surface benchSurface(const PictureSize& size, const Material& material, bool modulated)
{
    Surface surface = transferredSurface(wavyNormals(size.width, size.height), material);
    if (!modulated) {
        return surface;
    }
    surface.materials.assign(4, material);
    surface.albedo = Image(size.width, size.height, 3);
    for (size_t i = 0; i < surface.labels.size(); ++i) {
        surface.labels[i] = static_cast<uint8_t>(i / 61 % 4);
        for (size_t c = 0; c < 3; ++c) {
            surface.albedo.values[3 * i + c] = 0.5f + 0.01f * static_cast<float>((i + 7 * c) % 100);
        }
    }
    return surface;
}

std::vector<Light> benchLights(int count, int turn)
{
    std::vector<Light> lights;
    for (int i = 0; i < count; ++i) {
        const float azimuth = 2.3999632f * i + 0.01f * turn, slope = 0.9f * std::sqrt((i + 0.5f) / count);
        lights.push_back({glm::normalize(glm::vec3(slope * std::cos(azimuth), slope * std::sin(azimuth), 1)),
                          glm::vec3(1.0f / count)});
    }
    return lights;
}

ResidualLayer benchResidual(const Surface& surface, int components, int captured)
{
    ResidualLayer layer;
    layer.width = surface.normals.width;
    layer.height = surface.normals.height;
    layer.components = components;
    layer.trust = 0.8f;
    layer.low.assign(components, -0.02f);
    layer.high.assign(components, 0.02f);
    for (const Light& light : benchLights(captured, 0)) {
        layer.nodes.push_back(lightPlanePoint(light.direction));
    }
    for (size_t i = 0; i < components * layer.terms(); ++i) {
        layer.weights.emplace_back(static_cast<float>(hashed(i) % 1000) / 5000 - 0.1f);
    }
    layer.codes.resize(layer.layers() * layer.pixelCount() * kComponentsPerTexel);
    for (size_t i = 0; i < layer.codes.size(); ++i) {
        layer.codes[i] = static_cast<uint8_t>(hashed(i));
    }
    return layer;
}

} // namespace nacre
