#include "engine/surface/height_springs.h"

#include <algorithm>

#include "engine/surface/height_from_normals.h"

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

} // namespace

HeightSprings heightSprings(const NormalMap& normals)
{
    const size_t count = normals.normals.size();
    HeightSprings springs{GridSprings(normals.width, normals.height), std::vector<double>(count, 0.0),
                          std::vector<double>(count, 0.0)};
    const auto slopeBetween = [&](size_t a, size_t b) {
        return 0.5f * (slopeOfNormal(normals.normals[a], kLeastZ) + slopeOfNormal(normals.normals[b], kLeastZ));
    };
    for (int y = 0; y < normals.height; ++y) {
        for (int x = 0; x < normals.width; ++x) {
            const size_t i = normals.index(x, y);
            if (x + 1 < normals.width) {
                springs.grid.right[i] = weightOf(normals, i, i + 1);
                springs.riseRight[i] = slopeBetween(i, i + 1).x;
            }
            if (y + 1 < normals.height) {
                const size_t below = i + static_cast<size_t>(normals.width);
                springs.grid.down[i] = weightOf(normals, i, below);
                springs.riseDown[i] = -slopeBetween(i, below).y; // rows go down
            }
        }
    }
    return springs;
}

std::vector<double> pullOf(const HeightSprings& springs)
{
    const GridSprings& grid = springs.grid;
    std::vector<double> pull(grid.right.size(), 0.0);
    const auto add = [&](size_t from, size_t to, double weight, double rise) {
        if (weight > 0) {
            pull[to] += weight * rise;
            pull[from] -= weight * rise;
        }
    };
    for (size_t i = 0; i < pull.size(); ++i) {
        add(i, i + 1, grid.right[i], springs.riseRight[i]);
        add(i, i + static_cast<size_t>(grid.width), grid.down[i], springs.riseDown[i]);
    }
    return pull;
}

} // namespace nacre
