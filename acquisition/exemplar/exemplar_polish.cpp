#include "acquisition/exemplar/exemplar_polish.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <glm/geometric.hpp>

#include "acquisition/normals/lanes.h"

namespace nacre {

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
