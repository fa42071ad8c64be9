#include "acquisition/exemplar/predicted_ball.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

// The outermost texels look along the surface, where nothing is measured.
constexpr float kRim = 0.9975f; // radius on the disc

} // namespace

int PredictedBall::rowOf(const glm::vec3& normal) const
{
    glm::vec2 disc(normal.x, normal.y);
    const float limit = kRim - 1.5f / size; // so that the texel's centre is inside
    if (glm::length(disc) > limit) {
        disc *= limit / glm::length(disc);
    }
    const int x = std::clamp(static_cast<int>((disc.x + 1) / 2 * size), 0, size - 1);
    const int y = std::clamp(static_cast<int>((1 - disc.y) / 2 * size), 0, size - 1);
    return rows[static_cast<size_t>(y) * size + x];
}

glm::vec2 ballTexelOf(const glm::vec3& normal, int size)
{
    return {(normal.x + 1) / 2 * size - 0.5f, (1 - normal.y) / 2 * size - 0.5f};
}

glm::vec3 normalOfBallTexel(const glm::vec2& texel, int size)
{
    const glm::vec2 disc(2 * (texel.x + 0.5f) / size - 1, 1 - 2 * (texel.y + 0.5f) / size);
    return {disc, std::sqrt(std::max(0.0f, 1 - glm::dot(disc, disc)))};
}

std::optional<BallCell> findBallCell(const PredictedBall& ball, const glm::vec2& texel)
{
    const int x = static_cast<int>(std::floor(texel.x)), y = static_cast<int>(std::floor(texel.y));
    if (x < 0 || y < 0 || x + 1 >= ball.size || y + 1 >= ball.size) {
        return {};
    }
    BallCell cell;
    for (int i = 0; i < 4; ++i) {
        const int row = ball.rows[static_cast<size_t>(y + i / 2) * ball.size + x + i % 2];
        if (row < 0) {
            return {};
        }
        cell.columns[i] = ball.column(row);
    }
    cell.u = texel.x - static_cast<float>(x);
    cell.v = texel.y - static_cast<float>(y);
    return cell;
}

void PredictedBall::mixColumns(const glm::vec3& normal, float* mixed) const
{
    const std::optional<BallCell> cell = findBallCell(*this, ballTexelOf(normal, size));
    if (!cell) {
        std::copy_n(column(rowOf(normal)), stride, mixed);
        return;
    }
    const float a = (1 - cell->u) * (1 - cell->v), b = cell->u * (1 - cell->v), c = (1 - cell->u) * cell->v,
                d = cell->u * cell->v;
    for (size_t i = 0; i < stride; ++i) {
        mixed[i] =
            a * cell->columns[0][i] + b * cell->columns[1][i] + c * cell->columns[2][i] + d * cell->columns[3][i];
    }
}

PredictedBall makePredictedBall(int size, const std::vector<glm::vec3>& directions, const GreyReflectance& reflectance,
                                int threads)
{
    PredictedBall ball;
    ball.size = size;
    ball.lightCount = directions.size();
    ball.stride = (directions.size() + 7) / 8 * 8;
    ball.rows.assign(static_cast<size_t>(size) * size, -1);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const glm::vec3 normal = normalOfBallTexel({x, y}, size);
            if (glm::length(glm::vec2(normal)) < kRim) {
                ball.rows[static_cast<size_t>(y) * size + x] = static_cast<int>(ball.normals.size());
                ball.normals.push_back(normal);
            }
        }
    }
    ball.columns.assign(ball.normals.size() * ball.stride, 0.0f);
    parallelFor(ball.normals.size(), 64, threads, [&](size_t first, size_t last) {
        for (size_t row = first; row < last; ++row) {
            for (size_t i = 0; i < directions.size(); ++i) {
                const float nDotL = glm::dot(ball.normals[row], directions[i]);
                const float value = nDotL > 0 ? reflectance(ball.normals[row], directions[i]) * nDotL : 0.0f;
                ball.columns[row * ball.stride + i] = std::isfinite(value) ? std::max(value, 0.0f) : 0.0f;
            }
        }
    });
    ball.roots.resize(ball.columns.size());
    std::transform(ball.columns.begin(), ball.columns.end(), ball.roots.begin(), [](float v) { return std::sqrt(v); });
    return ball;
}

} // namespace nacre
