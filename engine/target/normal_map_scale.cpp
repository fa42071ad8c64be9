#include "engine/target/normal_map_scale.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace nacre {
namespace {

// Texels that one sample covers along a side, over the part's whole area: all of it, seen from the front.
double texelsPerSample(const Mesh& mesh, const MeshPart& part, double samplesPerUnit)
{
    double uvArea = 0, area = 0; // twice
    for (size_t i = part.firstIndex; i < part.firstIndex + part.indexCount; i += 3) {
        const uint32_t* v = &mesh.indices[i];
        const glm::dvec2 u1 = mesh.uvs[v[1]] - mesh.uvs[v[0]], u2 = mesh.uvs[v[2]] - mesh.uvs[v[0]];
        const glm::vec3 e1 = mesh.positions[v[1]] - mesh.positions[v[0]],
                        e2 = mesh.positions[v[2]] - mesh.positions[v[0]];
        uvArea += std::abs(u1.x * u2.y - u1.y * u2.x);
        area += glm::length(glm::cross(e1, e2));
    }
    const double texels = uvArea * part.normalMap->width * part.normalMap->height;
    return std::sqrt(texels / area) / samplesPerUnit;
}

} // namespace

NormalMap halvedNormalMap(const NormalMap& map)
{
    NormalMap half(map.width / 2, map.height / 2);
    for (int y = 0; y < half.height; ++y) {
        for (int x = 0; x < half.width; ++x) {
            const size_t i = map.index(2 * x, 2 * y), corners[] = {i, i + 1, i + map.width, i + map.width + 1};
            glm::vec3 sum(0);
            float known = 0;
            for (const size_t corner : corners) {
                if (map.confidence[corner] > 0) {
                    sum += map.normals[corner];
                    ++known;
                }
            }
            const size_t to = half.index(x, y);
            half.normals[to] = known > 0 ? sum / known : glm::vec3(0);
            half.confidence[to] = known > 0 ? 1.0f : 0.0f;
        }
    }
    return half;
}

NormalMap seenNormalMap(const Mesh& mesh, const MeshPart& part, double samplesPerUnit)
{
    NormalMap map = *part.normalMap;
    double texels = texelsPerSample(mesh, part, samplesPerUnit);
    // Bilinear reading spans two texels, so a step of up to 1.5 misses next to nothing.
    for (; texels > 1.5 && map.width > 1 && map.height > 1; texels *= 0.5) {
        map = halvedNormalMap(map);
    }
    return map;
}

} // namespace nacre
