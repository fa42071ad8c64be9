#include "acquisition/exemplar/exemplar_match.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "acquisition/normals/lanes.h"

namespace nacre {

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

} // namespace nacre
