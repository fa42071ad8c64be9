#include "engine/surface/height_from_normals.h"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "engine/surface/height_springs.h"

namespace nacre {
namespace {

// For each pixel with data, the first pixel of its piece; elsewhere itself.
std::vector<size_t> pieceRoots(const GridSprings& springs)
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
    HeightSprings springs = heightSprings(normals);
    const std::vector<double> pull = pullOf(springs);
    const std::vector<size_t> roots = pieceRoots(springs.grid);
    std::vector<double> height(normals.normals.size(), 0.0);
    SpringSolver solver(std::move(springs.grid), {}, options.threads);
    const SpringSolver::Result solved = solver.solve(pull, height, options.tolerance, options.mostIterations);

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
