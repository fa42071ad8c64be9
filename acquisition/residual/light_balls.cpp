#include "acquisition/residual/light_balls.h"

#include <algorithm>

#include <glm/common.hpp>

#include "engine/scene/parallel_for.h"
#include "engine/scene/reference.h"
#include "shared/ball.h"
#include "shared/shading.h"

namespace nacre {
namespace {

const glm::vec3 kCamera(0, 0, 1);

// Under all lights of irradiance 1: [channel * lights + light].
void setTexel(const Surface& surface, const BrdfTable& table, const glm::vec3& normal, float* texel)
{
    const size_t lights = surface.lights.size();
    for (size_t i = 0; i < lights; ++i) {
        const glm::vec3& l = surface.lights[i].light.direction;
        const float nDotL = glm::dot(normal, l);
        const glm::vec3 radiance =
            nDotL > 0 ? radianceFromBrdf(evaluateTable(table, normal, l, kCamera).value, glm::vec3(1), nDotL)
                      : glm::vec3(0);
        for (size_t c = 0; c < 3; ++c) {
            texel[c * lights + i] = radiance[static_cast<int>(c)];
        }
    }
}

std::vector<float> ballsOf(const Surface& surface, const BrdfTable& table, int size, int threads)
{
    const size_t values = 3 * surface.lights.size(), side = static_cast<size_t>(size);
    std::vector<float> balls(values * side * side);
    parallelFor(side, 2, threads, [&](size_t first, size_t last) {
        for (size_t y = first; y < last; ++y) {
            for (size_t x = 0; x < side; ++x) {
                const glm::vec2 texel = (glm::vec2(x, y) + 0.5f) / static_cast<float>(size);
                setTexel(surface, table, normalFromBallTexel(texel, static_cast<float>(size)),
                         &balls[(y * side + x) * values]);
            }
        }
    });
    return balls;
}

} // namespace

LightBalls::LightBalls(const Surface& surface, int size, int threads) : surface_(surface), size_(size)
{
    if (size > 0) {
        for (const Material& material : surface.materials) {
            materials_.push_back(ballsOf(surface, material.table, size, threads));
        }
    }
}

void LightBalls::addTexel(const float* texel, float share, const glm::vec3& albedo, std::span<float> predicted) const
{
    const size_t lights = surface_.lights.size();
    for (size_t c = 0; c < 3; ++c) {
        const float factor = share * albedo[static_cast<int>(c)];
        for (size_t i = c * lights; i < (c + 1) * lights; ++i) {
            predicted[i] += factor * texel[i];
        }
    }
}

void LightBalls::predict(size_t pixel, std::span<float> predicted) const
{
    const size_t lights = surface_.lights.size();
    std::fill(predicted.begin(), predicted.end(), 0.0f);
    const glm::vec3& normal = surface_.normals.normals[pixel];
    if (size_ == 0) {
        for (size_t i = 0; i < lights; ++i) {
            const Light light{surface_.lights[i].light.direction, glm::vec3(1)};
            const glm::vec3 radiance = brdfRadiance(surface_, pixel, light, kCamera);
            for (size_t c = 0; c < 3; ++c) {
                predicted[c * lights + i] = radiance[static_cast<int>(c)];
            }
        }
    } else if (normal.z > 0) {
        const std::vector<float>& balls = materials_[surface_.labels[pixel]];
        const glm::vec3 albedo = albedoFactor(surface_, pixel);
        const glm::vec2 place =
            ballTexelFromNormal(normal, static_cast<float>(size_)) * static_cast<float>(size_) - 0.5f;
        const glm::ivec2 corner = glm::clamp(glm::ivec2(place), glm::ivec2(0), glm::ivec2(size_ - 2));
        const glm::vec2 t = place - glm::vec2(corner);
        for (const glm::ivec2 step : {glm::ivec2(0, 0), glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(1, 1)}) {
            const glm::vec2 shares = glm::mix(1.0f - t, t, glm::vec2(step));
            const size_t texel = static_cast<size_t>(corner.y + step.y) * size_ + corner.x + step.x;
            addTexel(&balls[texel * 3 * lights], shares.x * shares.y, albedo, predicted);
        }
    }
}

} // namespace nacre
