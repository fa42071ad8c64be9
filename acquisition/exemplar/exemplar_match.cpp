#include "acquisition/exemplar/exemplar_match.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <glm/geometric.hpp>

#include "acquisition/normals/lanes.h"
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

namespace {

// The refit of the scale trusts residuals a little beyond the limit.
constexpr float kScaleLimit = 1.5f;

// A first scale that a few highlights do not move: least squares on square roots.
NACRE_VECTOR_CLONES
float roughScale(const float* column, const float* columnRoots, size_t stride, const MatchTarget& target)
{
    Lanes both = {}, own = {};
    for (size_t i = 0; i < stride; i += kLanes) {
        both += lanesAt(target.weights + i) * lanesAt(target.roots + i) * lanesAt(columnRoots + i);
        own += lanesAt(target.weights + i) * lanesAt(column + i);
    }
    const float down = sumOf(own), ratio = down > 0 ? sumOf(both) / down : 0.0f;
    return ratio * ratio;
}

// One step of reweighted least squares; weights fall linearly to zero at the limit.
NACRE_VECTOR_CLONES
float refittedScale(const float* column, size_t stride, const MatchTarget& target, float scale)
{
    const Lanes zero = {};
    const float limit = kScaleLimit * target.limit;
    Lanes up = {}, down = {};
    for (size_t i = 0; i < stride; i += kLanes) {
        const Lanes observed = lanesAt(target.observed + i), predicted = lanesAt(column + i);
        const Lanes difference = observed - scale * predicted;
        const Lanes left = limit - (difference > zero ? difference : -difference);
        const Lanes weight = (left > zero ? left : zero) * lanesAt(target.weights + i) * predicted;
        up += weight * observed;
        down += weight * predicted;
    }
    const float sum = sumOf(down);
    return sum > 0 ? sumOf(up) / sum : scale;
}

NACRE_VECTOR_CLONES
float truncatedCost(const float* column, size_t stride, const MatchTarget& target, float scale)
{
    const Lanes zero = {}, limit = zero + target.limit;
    Lanes costs = {}, weights = {};
    for (size_t i = 0; i < stride; i += kLanes) {
        const Lanes difference = lanesAt(target.observed + i) - scale * lanesAt(column + i);
        const Lanes residual = difference > zero ? difference : -difference;
        costs += lanesAt(target.weights + i) * (residual < limit ? residual : limit);
        weights += lanesAt(target.weights + i);
    }
    return sumOf(costs) / (sumOf(weights) * target.limit);
}

// Free scales start from the observations, bounded ones from the middle of their range.
float firstScale(const PredictedBall& ball, int row, const MatchTarget& target, const ScaleRange& range)
{
    return range.isFree() ? roughScale(ball.column(row), &ball.roots[row * ball.stride], ball.stride, target)
                          : std::sqrt(range.low * range.high);
}

Match matchRow(const PredictedBall& ball, int row, const MatchTarget& target, const ScaleRange& range)
{
    const float* column = ball.column(row);
    float scale = firstScale(ball, row, target, range);
    scale = std::clamp(refittedScale(column, ball.stride, target, scale), range.low, range.high);
    if (!(scale > 0)) {
        return {};
    }
    return {truncatedCost(column, ball.stride, target, scale), scale, row};
}

} // namespace

float fittedScale(const float* column, size_t stride, const MatchTarget& target, const ScaleRange& range)
{
    return std::clamp(refittedScale(column, stride, target, std::sqrt(range.low * range.high)), range.low, range.high);
}

Match findBestMatch(const PredictedBall& ball, const MatchTarget& target, const glm::vec3& start, float cosRadius,
                    const ScaleRange& range)
{
    // The cap's shadow on the disc lies within sin(radius) of its centre's.
    const float reach = cosRadius > 0 ? std::sqrt(1 - cosRadius * cosRadius) : 1.0f;
    const auto texel = [&](float disc) {
        return std::clamp(static_cast<int>(std::floor((disc + 1) / 2 * ball.size)), 0, ball.size - 1);
    };
    Match best;
    for (int y = texel(-start.y - reach); y <= texel(-start.y + reach); ++y) {
        for (int x = texel(start.x - reach); x <= texel(start.x + reach); ++x) {
            const int row = ball.rows[static_cast<size_t>(y) * ball.size + x];
            if (row >= 0 && glm::dot(ball.normals[row], start) >= cosRadius) {
                const Match match = matchRow(ball, row, target, range);
                if (match.cost < best.cost) {
                    best = match;
                }
            }
        }
    }
    return best;
}

glm::vec3 refinedNormal(const PredictedBall& ball, const MatchTarget& target, const Match& match,
                        const ScaleRange& range)
{
    const glm::vec3 centre = ball.normals[match.row];
    const int x = static_cast<int>((centre.x + 1) / 2 * ball.size),
              y = static_cast<int>((1 - centre.y) / 2 * ball.size);
    const auto costAt = [&](int tx, int ty) {
        const bool inside = tx >= 0 && ty >= 0 && tx < ball.size && ty < ball.size;
        const int row = inside ? ball.rows[static_cast<size_t>(ty) * ball.size + tx] : -1;
        return row >= 0 ? matchRow(ball, row, target, range).cost : 2.0f;
    };
    const auto shift = [&](float before, float after) {
        const float curvature = before - 2 * match.cost + after;
        const bool known = before <= 1 && after <= 1 && curvature > 0;
        return known ? std::clamp(0.5f * (before - after) / curvature, -0.5f, 0.5f) : 0.0f;
    };
    const glm::vec2 step(shift(costAt(x - 1, y), costAt(x + 1, y)), -shift(costAt(x, y - 1), costAt(x, y + 1)));
    const glm::vec2 disc = glm::vec2(centre) + step * (2.0f / ball.size);
    const float square = glm::dot(disc, disc);
    return square < 1 ? glm::vec3(disc, std::sqrt(1 - square)) : centre;
}

float matchCost(const float* column, size_t stride, const MatchTarget& target, float scale)
{
    return truncatedCost(column, stride, target, scale);
}

namespace {

constexpr int kSteps = 3;
// Texels: a step beyond leaves the cell whose slopes it was made of, all of them together the match's surroundings.
constexpr float kLongestStep = 0.5f;
constexpr float kFarthest = 1.0f;

// Weighted sums of a Gauss-Newton step for (x, y, scale), and the truncated cost where it starts.
struct Sums {
    Lanes xx = {}, xy = {}, xs = {}, yy = {}, ys = {}, ss = {}, xr = {}, yr = {}, sr = {}, cost = {};
};

NACRE_VECTOR_CLONES
void addUp(const BallCell& cell, size_t stride, const MatchTarget& target, float scale, Sums& sums)
{
    const Lanes zero = {}, limit = zero + target.limit;
    const float u = cell.u, v = cell.v;
    for (size_t i = 0; i < stride; i += kLanes) {
        const Lanes a = lanesAt(cell.columns[0] + i), b = lanesAt(cell.columns[1] + i),
                    c = lanesAt(cell.columns[2] + i), d = lanesAt(cell.columns[3] + i);
        const Lanes top = a + u * (b - a), bottom = c + u * (d - c);
        const Lanes predicted = top + v * (bottom - top);
        const Lanes alongX = scale * ((b - a) + v * ((d - c) - (b - a))), alongY = scale * (bottom - top);
        const Lanes residual = lanesAt(target.observed + i) - scale * predicted;
        const Lanes size = residual > zero ? residual : -residual, given = lanesAt(target.weights + i);
        const Lanes left = limit - size;
        const Lanes weight = (left > zero ? left : zero) * given;
        sums.cost += given * (size < limit ? size : limit);
        sums.xx += weight * alongX * alongX;
        sums.xy += weight * alongX * alongY;
        sums.xs += weight * alongX * predicted;
        sums.yy += weight * alongY * alongY;
        sums.ys += weight * alongY * predicted;
        sums.ss += weight * predicted * predicted;
        sums.xr += weight * alongX * residual;
        sums.yr += weight * alongY * residual;
        sums.sr += weight * predicted * residual;
    }
}

// (x, y, scale); zero where the observations do not determine it.
Eigen::Vector3f stepOf(const Sums& sums)
{
    Eigen::Matrix3f a;
    a << sumOf(sums.xx), sumOf(sums.xy), sumOf(sums.xs), sumOf(sums.xy), sumOf(sums.yy), sumOf(sums.ys), sumOf(sums.xs),
        sumOf(sums.ys), sumOf(sums.ss);
    a.diagonal() *= 1.001f;
    const Eigen::LLT<Eigen::Matrix3f> factors(a);
    const Eigen::Vector3f step = factors.solve(Eigen::Vector3f(sumOf(sums.xr), sumOf(sums.yr), sumOf(sums.sr)));
    return factors.info() == Eigen::Success && step.allFinite() ? step : Eigen::Vector3f::Zero();
}

} // namespace

PolishedMatch polishedMatch(const PredictedBall& ball, const MatchTarget& target, const Match& match,
                            const glm::vec3& normal, const ScaleRange& range)
{
    const glm::vec2 start = ballTexelOf(ball.normals[match.row], ball.size);
    glm::vec2 texel = ballTexelOf(normal, ball.size), best = texel;
    float scale = match.scale, bestScale = scale, bestCost = std::numeric_limits<float>::max();
    for (int step = 0; step <= kSteps; ++step) {
        const std::optional<BallCell> cell = findBallCell(ball, texel);
        if (!cell) {
            break;
        }
        Sums sums;
        addUp(*cell, ball.stride, target, scale, sums);
        const float cost = sumOf(sums.cost);
        if (!(cost < bestCost)) {
            break;
        }
        best = texel, bestScale = scale, bestCost = cost;
        const Eigen::Vector3f delta = stepOf(sums);
        const glm::vec2 limited = glm::clamp(glm::vec2(delta.x(), delta.y()), -kLongestStep, kLongestStep);
        texel = glm::clamp(texel + limited, start - kFarthest, start + kFarthest);
        scale = std::clamp(scale + delta.z(), range.low, range.high);
    }
    return {normalOfBallTexel(best, ball.size), bestScale};
}

} // namespace nacre
