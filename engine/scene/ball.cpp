#include "engine/scene/ball.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/files/parallel_for.h"
#include "shared/ball.h"
#include "shared/shading.h"

namespace nacre {

Ball makeBall(const BrdfTable& table, std::span<const Light> lights, int size, int threads)
{
    const glm::vec3 view(0, 0, 1);
    Ball ball{Image(size, size, 3)};
    parallelFor(size, 4, threads, [&](size_t first, size_t last) {
        for (int y = static_cast<int>(first); y < static_cast<int>(last); ++y) {
            for (int x = 0; x < size; ++x) {
                const glm::vec2 texel((x + 0.5f) / size, (y + 0.5f) / size);
                const glm::vec3 n = normalFromBallTexel(texel, static_cast<float>(size));
                glm::vec3 sum(0);
                for (const Light& light : lights) {
                    const float nDotL = glm::dot(n, light.direction);
                    if (nDotL > 0) {
                        sum += radianceFromBrdf(evaluateTable(table, n, light.direction, view).value, light.irradiance,
                                                nDotL);
                    }
                }
                ball.radiance.setRgb(x, y, sum);
            }
        }
    });
    return ball;
}

namespace {

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

glm::vec3 sampleBall(const Ball& ball, const glm::vec3& normal)
{
    return filteredBall(ball, ballTexelFromNormal(normal, static_cast<float>(ball.radiance.width)));
}

glm::vec3 sampleStretchedBall(const Ball& ball, int displaySize, const glm::vec3& normal)
{
    const auto size = static_cast<float>(displaySize);
    const glm::vec2 texel = (glm::vec2(nearestBallTexel(discFromNormal(normal), displaySize)) + 0.5f) / size;
    return filteredBall(ball, resizedBallTexel(texel, size, static_cast<float>(ball.radiance.width)));
}

} // namespace nacre
