#include "engine/target/height_from_normals.h"

#include <algorithm>
#include <numeric>

#include "engine/target/grid_laplacian.h"
#include "engine/target/slope.h"

namespace nacre {
namespace {

// 84 degrees: a wall that is steeper is drawn so steep.
constexpr float kLeastZ = 0.1f;

// An error of the normal's angle moves its slope by 1 / nz^2 of it, hence the inverse variance nz^4, here shared by the
// pair.
double weightOf(const NormalMap& map, size_t a, size_t b)
{
    const double za = std::max(map.normals[a].z, kLeastZ), zb = std::max(map.normals[b].z, kLeastZ);
    const float confidence = std::min(map.confidence[a], map.confidence[b]);
    return confidence > 0 ? confidence * za * za * zb * zb : 0.0;
}

struct Equations {
    GridLaplacian springs;
    std::vector<double> pull; // right side
};

// Minimum of sum w (z_j - z_i - rise)^2, the rise between two pixels by the trapezoidal rule.
Equations equationsOf(const NormalMap& map)
{
    Equations equations{GridLaplacian(map.width, map.height), std::vector<double>(map.normals.size(), 0.0)};
    const auto join = [&](size_t from, size_t to, double& spring, bool vertical) {
        const double weight = weightOf(map, from, to);
        if (weight == 0) {
            return;
        }
        const glm::vec2 slope =
            0.5f * (slopeOfNormal(map.normals[from], kLeastZ) + slopeOfNormal(map.normals[to], kLeastZ));
        const double rise = vertical ? -slope.y : slope.x; // rows go down
        spring = weight;
        equations.pull[to] += weight * rise;
        equations.pull[from] -= weight * rise;
    };
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const size_t i = map.index(x, y);
            if (x + 1 < map.width) {
                join(i, i + 1, equations.springs.right[i], false);
            }
            if (y + 1 < map.height) {
                join(i, i + map.width, equations.springs.down[i], true);
            }
        }
    }
    equations.springs.sumDiagonal();
    return equations;
}

// For each pixel with data, the first pixel of its piece; elsewhere itself.
std::vector<size_t> pieceRoots(const GridLaplacian& springs)
{
    std::vector<size_t> parent(springs.size());
    std::iota(parent.begin(), parent.end(), size_t{0});
    const auto rootOf = [&](size_t i) {
        while (parent[i] != i) {
            i = parent[i] = parent[parent[i]];
        }
        return i;
    };
    const auto unite = [&](size_t a, size_t b) {
        const size_t rootA = rootOf(a), rootB = rootOf(b);
        parent[std::max(rootA, rootB)] = std::min(rootA, rootB);
    };
    for (size_t i = 0; i < parent.size(); ++i) {
        if (springs.right[i] > 0) {
            unite(i, i + 1);
        }
        if (springs.down[i] > 0) {
            unite(i, i + springs.width);
        }
    }
    for (size_t i = 0; i < parent.size(); ++i) {
        parent[i] = rootOf(i);
    }
    return parent;
}

// Takes each piece's mean away and returns how many pieces there are.
size_t centrePieces(const NormalMap& map, const std::vector<size_t>& roots, std::vector<double>& height)
{
    std::vector<double> sums(height.size(), 0.0);
    std::vector<size_t> counts(height.size(), 0);
    size_t pieces = 0;
    for (size_t i = 0; i < height.size(); ++i) {
        if (map.confidence[i] > 0) {
            pieces += roots[i] == i;
            sums[roots[i]] += height[i];
            ++counts[roots[i]];
        }
    }
    for (size_t i = 0; i < height.size(); ++i) {
        height[i] = map.confidence[i] > 0 ? height[i] - sums[roots[i]] / static_cast<double>(counts[roots[i]]) : 0.0;
    }
    return pieces;
}

} // namespace

IntegratedHeight heightFromNormals(const NormalMap& normals, const IntegrationOptions& options)
{
    Equations equations = equationsOf(normals);
    const std::vector<size_t> roots = pieceRoots(equations.springs);
    std::vector<double> height(normals.normals.size(), 0.0);
    GridSolver solver(std::move(equations.springs), options.threads);
    const GridSolver::Result solved = solver.solve(equations.pull, height, options.tolerance, options.mostIterations);

    IntegratedHeight result;
    result.iterations = solved.iterations;
    result.residual = solved.residual;
    result.pieces = centrePieces(normals, roots, height);
    result.height = Image(normals.width, normals.height, 1);
    std::transform(height.begin(), height.end(), result.height.values.begin(),
                   [](double z) { return static_cast<float>(z); });
    return result;
}

} // namespace nacre
