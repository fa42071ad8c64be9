#include "acquisition/exemplar/ball_match.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <glm/geometric.hpp>

#include "engine/files/lanes.h"
#include "engine/files/measures.h"

namespace nacre {

namespace {

// Scales are fitted to residuals up to so many times the truncation.
constexpr float kFitLimit = 1.5f;
// The middling quantile is in the light if it is at least this share of the bright level.
constexpr float kLitShare = 0.04f;
constexpr int kAdditiveSteps = 2;
constexpr int kPolishSteps = 3;
// A dark observation, 4 % of the bright level, is often a light that something is in front of: against a prediction
// that is lit it costs a quarter of what others may.
constexpr float kDarkRoot = 0.2f;
constexpr float kDarkShare = 0.25f;

NACRE_ON_LANES Lanes costOf(const Lanes& observed, const Lanes& residual, const Lanes& truncation)
{
    const Lanes most = observed < kDarkRoot ? kDarkShare * truncation : truncation;
    return residual < most ? residual : most;
}

// g = root * column: one reweighted step from the root given. Observations that are no number take no part.
NACRE_VECTOR_CLONES
void matchRoots(const float* observed, const float* column, size_t stride, float lowRoot, float highRoot,
                float truncation, float& root, float& cost)
{
    Lanes numerator = allLanes(0), denominator = allLanes(0);
    for (size_t i = 0; i < stride; i += kLanes) {
        const Lanes c = lanesAt(column + i), g = lanesAt(observed + i);
        const auto isNear = absolute(g - root * c) < kFitLimit * truncation;
        numerator += isNear ? c * g : allLanes(0);
        denominator += isNear ? c * c : allLanes(0);
    }
    const float sum = sumOf(denominator);
    root = std::clamp(sum > 0 ? sumOf(numerator) / sum : root, lowRoot, highRoot);
    const Lanes most = allLanes(truncation);
    Lanes costs = allLanes(0);
    for (size_t i = 0; i < stride; i += kLanes) {
        const Lanes g = lanesAt(observed + i);
        costs += costOf(g, absolute(g - root * lanesAt(column + i)), most);
    }
    cost = sumOf(costs);
}

NACRE_ON_LANES Lanes glossyPrediction(const float* diffuse, const float* gloss, float scale, float inverseBright)
{
    const Lanes matte = scale * lanesAt(diffuse), all = matte + inverseBright * lanesAt(gloss),
                least = kLeastGlossShare * matte;
    return all > least ? all : least;
}

// g = sqrt(scale diffuse + gloss / bright): Gauss-Newton steps in the scale, d sqrt(p) / d scale = diffuse / 2 sqrt(p).
NACRE_VECTOR_CLONES
void matchGlossy(const float* observed, const float* diffuse, const float* gloss, size_t stride, float inverseBright,
                 float low, float high, float truncation, float& scale, float& cost)
{
    for (int step = 0; step < kAdditiveSteps; ++step) {
        Lanes numerator = allLanes(0), denominator = allLanes(0);
        for (size_t i = 0; i < stride; i += kLanes) {
            const Lanes root = rootOf(glossyPrediction(diffuse + i, gloss + i, scale, inverseBright));
            const Lanes residual = lanesAt(observed + i) - root;
            const Lanes slope = lanesAt(diffuse + i) / (2 * root + 1e-6f);
            const auto isNear = absolute(residual) < kFitLimit * truncation;
            numerator += isNear ? slope * residual : allLanes(0);
            denominator += isNear ? slope * slope : allLanes(0);
        }
        const float sum = sumOf(denominator);
        if (sum > 0) {
            // A step far beyond what the slope describes is cut.
            scale = std::clamp(scale + sumOf(numerator) / sum, std::max(low, 0.3f * scale), std::min(high, 3 * scale));
        }
    }
    const Lanes most = allLanes(truncation);
    Lanes costs = allLanes(0);
    for (size_t i = 0; i < stride; i += kLanes) {
        const Lanes g = lanesAt(observed + i);
        costs += costOf(g, absolute(g - rootOf(glossyPrediction(diffuse + i, gloss + i, scale, inverseBright))), most);
    }
    cost = sumOf(costs);
}

// Four columns around a place on the ball, bilinearly mixed.
struct BallCell {
    std::array<const float*, 4> diffuse{}, gloss{}; // of (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)
    float u = 0, v = 0;
};

// A column's values at the cell's place.
NACRE_ON_LANES Lanes mixed(const BallCell& cell, const std::array<const float*, 4>& columns, size_t i)
{
    return (1 - cell.v) * ((1 - cell.u) * lanesAt(columns[0] + i) + cell.u * lanesAt(columns[1] + i)) +
           cell.v * ((1 - cell.u) * lanesAt(columns[2] + i) + cell.u * lanesAt(columns[3] + i));
}

// Their derivatives by x and y.
NACRE_ON_LANES Lanes alongX(const BallCell& cell, const std::array<const float*, 4>& columns, size_t i)
{
    return (1 - cell.v) * (lanesAt(columns[1] + i) - lanesAt(columns[0] + i)) +
           cell.v * (lanesAt(columns[3] + i) - lanesAt(columns[2] + i));
}

NACRE_ON_LANES Lanes alongY(const BallCell& cell, const std::array<const float*, 4>& columns, size_t i)
{
    return (1 - cell.u) * (lanesAt(columns[2] + i) - lanesAt(columns[0] + i)) +
           cell.u * (lanesAt(columns[3] + i) - lanesAt(columns[1] + i));
}

std::optional<BallCell> findCell(const ReflectanceBall& ball, const glm::vec2& texel)
{
    const BallGrid& grid = *ball.grid;
    const int x = std::clamp(static_cast<int>(std::floor(texel.x)), 0, grid.size - 2),
              y = std::clamp(static_cast<int>(std::floor(texel.y)), 0, grid.size - 2);
    BallCell cell;
    for (int k = 0; k < 4; ++k) {
        const int row = grid.rows[static_cast<size_t>(y + k / 2) * grid.size + x + k % 2];
        if (row < 0) {
            return {};
        }
        cell.diffuse[k] = &ball.diffuse[row * grid.stride];
        cell.gloss[k] = ball.additive ? &ball.gloss[row * grid.stride] : nullptr;
    }
    cell.u = std::clamp(texel.x - static_cast<float>(x), 0.0f, 1.0f);
    cell.v = std::clamp(texel.y - static_cast<float>(y), 0.0f, 1.0f);
    return cell;
}

// Predicted roots and their derivatives by x, y and scale.
struct RootLanes {
    Lanes root, byX, byY, byScale;
};

NACRE_ON_LANES RootLanes predictRoots(const BallCell& cell, bool additive, size_t i, float scale, float inverseBright)
{
    const Lanes diffuse = mixed(cell, cell.diffuse, i);
    Lanes value = scale * diffuse, byX = scale * alongX(cell, cell.diffuse, i),
          byY = scale * alongY(cell, cell.diffuse, i), byScale = diffuse;
    if (additive) {
        const Lanes all = value + inverseBright * mixed(cell, cell.gloss, i), least = kLeastGlossShare * value;
        const auto isAll = all > least;
        byX = isAll ? byX + inverseBright * alongX(cell, cell.gloss, i) : kLeastGlossShare * byX;
        byY = isAll ? byY + inverseBright * alongY(cell, cell.gloss, i) : kLeastGlossShare * byY;
        byScale = isAll ? byScale : kLeastGlossShare * byScale;
        value = isAll ? all : least;
    }
    const Lanes root = rootOf(value), half = root > 1e-4f ? 0.5f / root : allLanes(0);
    return {root, half * byX, half * byY, half * byScale};
}

// The normal equations of one step in (x, y, scale), and the cost where it starts.
struct StepEquations {
    Eigen::Matrix3f matrix;
    Eigen::Vector3f right;
    float cost = 0;
};

NACRE_VECTOR_CLONES
void equationsAt(const BallCell& cell, bool additive, const float* observed, size_t stride, float scale,
                 float inverseBright, float truncation, StepEquations& equations)
{
    const Lanes most = allLanes(truncation);
    Lanes xx = {}, xy = {}, xs = {}, yy = {}, ys = {}, ss = {}, x = {}, y = {}, s = {}, costs = {};
    for (size_t i = 0; i < stride; i += kLanes) {
        const RootLanes predicted = predictRoots(cell, additive, i, scale, inverseBright);
        const Lanes g = lanesAt(observed + i), residual = g - predicted.root, size = absolute(residual);
        costs += costOf(g, size, most);
        const auto isNear = size < kFitLimit * truncation;
        const Lanes weight = isNear ? 1 - size / (kFitLimit * truncation) : allLanes(0);
        const Lanes weighted = isNear ? weight * residual : allLanes(0);
        const Lanes wx = weight * predicted.byX, wy = weight * predicted.byY;
        xx += wx * predicted.byX;
        xy += wx * predicted.byY;
        xs += wx * predicted.byScale;
        yy += wy * predicted.byY;
        ys += wy * predicted.byScale;
        ss += weight * predicted.byScale * predicted.byScale;
        x += weighted * predicted.byX;
        y += weighted * predicted.byY;
        s += weighted * predicted.byScale;
    }
    equations.matrix << sumOf(xx), sumOf(xy), sumOf(xs), sumOf(xy), sumOf(yy), sumOf(ys), sumOf(xs), sumOf(ys),
        sumOf(ss);
    equations.right << sumOf(x), sumOf(y), sumOf(s);
    equations.cost = sumOf(costs);
}

// A step changes scales by a factor of two at most.
float steppedScale(const AlbedoRange& albedos, float inverseBright, float scale, float change)
{
    const float low = albedos.low * inverseBright, high = albedos.high * inverseBright;
    return albedos.low == albedos.high
               ? low
               : std::clamp(scale + change, std::max(low, 0.5f * scale), std::min(high, 2 * scale));
}

StepEquations equationsAt(const MatchModel& model, const PixelLattice& lattice, size_t pixel, const BallCell& cell,
                          float scale)
{
    StepEquations equations;
    equationsAt(cell, model.ball.additive, lattice.rootsOf(pixel), lattice.stride, scale, 1 / lattice.bright[pixel],
                model.truncation, equations);
    equations.cost /= model.truncation * static_cast<float>(lattice.lightCount);
    return equations;
}

} // namespace

BallMatch matchAtRow(const MatchModel& model, const PixelLattice& lattice, size_t pixel, int row, float scale)
{
    const BallGrid& grid = *model.ball.grid;
    const float bright = lattice.bright[pixel], low = model.albedos.low / bright, high = model.albedos.high / bright;
    const float* diffuse = &model.ball.diffuse[row * grid.stride];
    BallMatch match{{}, 0, 2, row};
    if (model.ball.additive) {
        match.scale = std::clamp(scale, low, high);
        matchGlossy(lattice.rootsOf(pixel), diffuse, &model.ball.gloss[row * grid.stride], grid.stride, 1 / bright, low,
                    high, model.truncation, match.scale, match.cost);
    } else {
        if (model.ball.bright[row] <= 0) {
            return match;
        }
        const float lowRoot = std::sqrt(low), highRoot = std::sqrt(high);
        const float middling = lattice.middling[pixel], predicted = model.ball.middling[row];
        const bool isLit = middling > kLitShare && predicted > kLitShare * model.ball.bright[row];
        float root =
            std::clamp(std::sqrt(isLit ? middling / predicted : 1 / model.ball.bright[row]), lowRoot, highRoot);
        matchRoots(lattice.rootsOf(pixel), &model.ball.roots[row * grid.stride], grid.stride, lowRoot, highRoot,
                   model.truncation, root, match.cost);
        match.scale = root * root;
    }
    match.cost /= model.truncation * static_cast<float>(grid.lightCount);
    return match;
}

BallMatch polishedMatch(const MatchModel& model, const PixelLattice& lattice, size_t pixel, const BallMatch& match)
{
    const BallGrid& grid = *model.ball.grid;
    const float inverseBright = 1 / lattice.bright[pixel];
    BallMatch best = match, current = match;
    best.cost = 2;
    for (int step = 0; step <= kPolishSteps; ++step) {
        const std::optional<BallCell> cell = findCell(model.ball, current.texel);
        if (!cell || !(current.scale > 0)) {
            break;
        }
        StepEquations equations = equationsAt(model, lattice, pixel, *cell, current.scale);
        current.cost = equations.cost;
        if (current.cost < best.cost) {
            best = current;
        }
        if (model.albedos.low == model.albedos.high) {
            equations.matrix.row(2) << 0, 0, 1;
            equations.matrix.col(2) << 0, 0, 1;
        }
        // Damped by a thousandth, so that a direction that no observation tells stays where it is.
        equations.matrix.diagonal() *= 1.001f;
        equations.matrix.diagonal().array() += 1e-9f;
        const Eigen::Vector3f change = equations.matrix.ldlt().solve(equations.right);
        if (!change.allFinite()) {
            break;
        }
        glm::vec2 moved = current.texel + glm::vec2(change.x(), change.y()) - match.texel;
        moved /= std::max(1.0f, glm::length(moved));
        current.texel = match.texel + moved;
        current.scale = steppedScale(model.albedos, inverseBright, current.scale, change.z());
    }
    if (best.cost > 1) {
        return match;
    }
    best.row = grid.rowAt(best.texel);
    return best;
}

BallMatch matchAtTexel(const MatchModel& model, const PixelLattice& lattice, size_t pixel, const glm::vec2& texel,
                       float scale)
{
    const BallGrid& grid = *model.ball.grid;
    const int row = grid.rowAt(texel);
    if (row < 0) {
        return {texel, 0, 2, -1};
    }
    BallMatch match = matchAtRow(model, lattice, pixel, row, scale);
    match.texel = texel;
    const std::optional<BallCell> cell = findCell(model.ball, texel);
    const float inverseBright = 1 / lattice.bright[pixel];
    for (int step = 0; step <= kPolishSteps && cell && match.scale > 0; ++step) {
        const StepEquations equations = equationsAt(model, lattice, pixel, *cell, match.scale);
        match.cost = equations.cost;
        if (step < kPolishSteps && equations.matrix(2, 2) > 0) {
            match.scale =
                steppedScale(model.albedos, inverseBright, match.scale, equations.right.z() / equations.matrix(2, 2));
        }
    }
    return match;
}

void predictMatch(const MatchModel& model, const BallMatch& match, float bright, float* predicted)
{
    const BallGrid& grid = *model.ball.grid;
    const std::optional<BallCell> cell = findCell(model.ball, match.texel);
    if (!cell) {
        std::fill_n(predicted, grid.lightCount, 0.0f);
        return;
    }
    for (size_t i = 0; i < grid.lightCount; i += kLanes) {
        const Lanes root = predictRoots(*cell, model.ball.additive, i, match.scale, 1 / bright).root,
                    values = root * root * bright;
        std::copy_n(reinterpret_cast<const float*>(&values), std::min<size_t>(kLanes, grid.lightCount - i),
                    predicted + i);
    }
}

void forgetCosts(std::vector<BallMatch>& matches)
{
    for (BallMatch& match : matches) {
        match.cost = 2;
    }
}

double meanCost(const std::vector<BallMatch>& matches)
{
    double sum = 0;
    for (const BallMatch& match : matches) {
        sum += std::min(1.0f, match.cost);
    }
    return sum / static_cast<double>(std::max<size_t>(1, matches.size()));
}

float medianCost(const std::vector<BallMatch>& matches)
{
    std::vector<float> costs;
    for (const BallMatch& match : matches) {
        costs.push_back(match.cost);
    }
    return costs.empty() ? 1.0f : quantile(costs, 0.5);
}

} // namespace nacre
