#include "tests/gpu/scenes.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace nacre::test {

Material materialOf(const BrdfModel& model, TableDomain domain, glm::ivec3 size)
{
    Material material{.name = "model", .table = BrdfTable(size, domain), .coverage = {}};
    BrdfTable& table = material.table;
    for (int k = 0; k < size.z; ++k) {
        for (int j = 0; j < size.y; ++j) {
            for (int i = 0; i < size.x; ++i) {
                const LightView pair = table.directions(i, j, k);
                table.values[table.index(i, j, k)] = evaluate(model, {0, 0, 1}, pair.l, pair.v);
                table.confidence[table.index(i, j, k)] = 1;
            }
        }
    }
    return material;
}

Material glossyMaterial(TableDomain domain)
{
    const LambertGgx model{.diffuse = {0.4f, 0.2f, 0.05f}, .specular = {0.05f, 0.1f, 0.5f}, .alpha = 0.08f};
    return materialOf(model, domain, {64, 24, 16});
}

Material oneWayMaterial()
{
    Material material = glossyMaterial({kOneWay, kHalfPi});
    const size_t slice = material.table.values.size() / static_cast<size_t>(material.table.size.z);
    for (size_t i = 0; i < material.table.values.size(); ++i) {
        material.table.values[i] *= 1 + 0.1f * static_cast<float>(i / slice);
    }
    return material;
}

NormalMap bumpyNormals(int width, int height)
{
    NormalMap map(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float u = 2 * (x + 0.5f) / width - 1;
            const float v = 1 - 2 * (y + 0.5f) / height;
            const float polar = 1.15f * kHalfPi * std::hypot(u, v);
            const bool hole = std::hypot(u - 0.3f, v - 0.3f) < 0.2f;
            if (hole || polar > kPi) {
                continue;
            }
            const float azimuth = std::atan2(v, u);
            const glm::vec3 smooth(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                                   std::cos(polar));
            const glm::vec3 waves(0.1f * std::sin(17 * u), 0.1f * std::cos(13 * v), 0);
            map.normals[map.index(x, y)] = glm::normalize(smooth + waves);
            map.confidence[map.index(x, y)] = 0.25f + 0.5f * std::abs(u);
        }
    }
    return map;
}

std::vector<Light> capOfLights(int count, float maxDegrees)
{
    const float goldenAngle = 2.3999632f;
    const float lowestZ = std::cos(maxDegrees * kPi / 180);
    std::vector<Light> lights(count);
    for (int i = 0; i < count; ++i) {
        const float z = 1 - (1 - lowestZ) * (i + 0.5f) / count;
        const float r = std::sqrt(1 - z * z);
        const float azimuth = goldenAngle * i;
        lights[i].direction = glm::normalize(glm::vec3(r * std::cos(azimuth), r * std::sin(azimuth), z));
        lights[i].irradiance = glm::vec3(1 + i % 3, 1 + (i + 1) % 4, 0.5f + i % 2) / float(count);
    }
    return lights;
}

Scene glossyScene(int width, int height)
{
    Scene scene;
    scene.surface = transferredSurface(bumpyNormals(width, height), glossyMaterial());
    scene.lights = capOfLights(3, 60);
    return scene;
}

} // namespace nacre::test
