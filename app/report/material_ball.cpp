#include "app/report/material_ball.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/brdf/brdf_audit.h"
#include "engine/files/parallel_for.h"
#include "engine/lights/light_rigs.h"
#include "engine/surface/normal_map.h"
#include "shared/shading.h"

namespace nacre {

Image materialBall(const BrdfModel& model, std::span<const Light> lights, int size, int threads)
{
    constexpr glm::vec3 kView(0, 0, 1);
    const NormalMap sphere = sphereNormalMap(size);
    Image picture(size, size, 3);
    parallelFor(picture.pixelCount(), 1024, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            const glm::vec3 n = sphere.normals[i];
            glm::vec3 radiance(0);
            for (const Light& light : lights) {
                const float nDotL = glm::dot(n, light.direction);
                if (sphere.confidence[i] > 0 && nDotL > 0) {
                    radiance += radianceFromBrdf(evaluate(model, n, light.direction, kView), light.irradiance, nDotL);
                }
            }
            std::copy_n(&radiance.x, 3, &picture.values[3 * i]);
        }
    });
    return picture;
}

Image materialThumbnail(const BrdfModel& model, int size)
{
    constexpr float kSurroundings = 0.04f;       // radiance beside the key's irradiance of 1
    constexpr std::array kAngles{0, 30, 55, 75}; // degrees; flatter views have the last one's
    const std::vector<Light> key = lightsOfRig("key");
    std::array<glm::vec3, kAngles.size()> albedos;
    for (size_t i = 0; i < kAngles.size(); ++i) {
        albedos[i] = directionalAlbedo(functionOf(model), kAngles[i]).albedo;
    }
    Image picture = materialBall(model, key, size, 1);
    const NormalMap sphere = sphereNormalMap(size);
    for (size_t pixel = 0; pixel < picture.pixelCount(); ++pixel) {
        if (sphere.confidence[pixel] <= 0) {
            continue;
        }
        const float theta = glm::degrees(std::acos(std::min(sphere.normals[pixel].z, 1.0f)));
        size_t i = 0;
        while (i + 2 < kAngles.size() && theta > kAngles[i + 1]) {
            ++i;
        }
        const float along = (theta - kAngles[i]) / static_cast<float>(kAngles[i + 1] - kAngles[i]);
        const glm::vec3 albedo = glm::mix(albedos[i], albedos[i + 1], glm::clamp(along, 0.0f, 1.0f));
        for (int c = 0; c < 3; ++c) {
            picture.values[3 * pixel + c] += kSurroundings * albedo[c];
        }
    }
    return picture;
}

} // namespace nacre
