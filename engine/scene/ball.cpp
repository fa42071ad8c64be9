#include "engine/scene/ball.h"

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
#include "shared/ball.h"
#include "shared/shading.h"

namespace nacre {

Image materialBall(const LitAndSeen& f, std::span<const Light> lights, int size, int threads)
{
    const NormalMap sphere = sphereNormalMap(size);
    Image picture(size, size, 3);
    parallelFor(picture.pixelCount(), 1024, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            const glm::vec3 n = sphere.normals[i];
            if (sphere.confidence[i] > 0) {
                const glm::vec3 radiance =
                    radianceUnder(lights, n, [&](const glm::vec3& l) { return f(n, l, kFrontView); });
                std::copy_n(&radiance.x, 3, &picture.values[3 * i]);
            }
        }
    });
    return picture;
}

Image materialBall(const BrdfModel& model, std::span<const Light> lights, int size, int threads)
{
    return materialBall(
        [&](const glm::vec3& n, const glm::vec3& l, const glm::vec3& v) { return evaluate(model, n, l, v); }, lights,
        size, threads);
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

namespace {

template <class At> Ball filledBall(int size, int threads, At&& at)
{
    Ball ball{Image(size, size, 3)};
    parallelFor(size, 4, threads, [&](size_t first, size_t last) {
        for (int y = static_cast<int>(first); y < static_cast<int>(last); ++y) {
            for (int x = 0; x < size; ++x) {
                const glm::vec2 texel((x + 0.5f) / size, (y + 0.5f) / size);
                ball.radiance.setRgb(x, y, at(normalFromBallTexel(texel, static_cast<float>(size))));
            }
        }
    });
    return ball;
}

// At texture coordinates.
glm::vec3 filteredBall(const Ball& ball, const glm::vec2& texel)
{
    const int size = ball.radiance.width;
    const glm::vec2 position = texel * static_cast<float>(size) - 0.5f;
    const int x = std::clamp(static_cast<int>(position.x), 0, size - 2),
              y = std::clamp(static_cast<int>(position.y), 0, size - 2);
    const glm::vec2 t = position - glm::vec2(x, y);
    const glm::vec3 top = glm::mix(ball.radiance.rgb(x, y), ball.radiance.rgb(x + 1, y), t.x);
    const glm::vec3 bottom = glm::mix(ball.radiance.rgb(x, y + 1), ball.radiance.rgb(x + 1, y + 1), t.x);
    return glm::mix(top, bottom, t.y);
}

} // namespace

Ball makeBall(const BrdfTable& table, std::span<const Light> lights, int size, int threads)
{
    return filledBall(size, threads, [&](const glm::vec3& n) {
        return radianceUnder(lights, n,
                             [&](const glm::vec3& l) { return evaluateTable(table, n, l, kFrontView).value; });
    });
}

glm::vec3 sampleBall(const Ball& ball, const glm::vec3& normal)
{
    return filteredBall(ball, ballTexelFromNormal(normal, static_cast<float>(ball.radiance.width)));
}

Ball makeMeanBall(const BrdfTable& table, std::span<const Light> lights, int size, int threads)
{
    return filledBall(size, threads, [&](const glm::vec3& n) {
        glm::vec3 sum(0), shares(1e-9f);
        for (const Light& light : lights) {
            const glm::vec3 share = shareInMean(light.irradiance, glm::dot(n, light.direction));
            sum += share * evaluateTable(table, n, light.direction, kFrontView).value;
            shares += share;
        }
        return sum / shares;
    });
}

glm::vec3 sampleMeanBall(const Ball& ball, std::span<const Light> lights, const glm::vec3& normal)
{
    const glm::vec3 f = sampleBall(ball, normal);
    return radianceUnder(lights, normal, [&](const glm::vec3&) { return f; });
}

glm::vec3 sampleStretchedBall(const Ball& ball, int displaySize, const glm::vec3& normal)
{
    const auto size = static_cast<float>(displaySize);
    const glm::vec2 texel = (glm::vec2(nearestBallTexel(discFromNormal(normal), displaySize)) + 0.5f) / size;
    return filteredBall(ball, resizedBallTexel(texel, size, static_cast<float>(ball.radiance.width)));
}

} // namespace nacre
