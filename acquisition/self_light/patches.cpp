#include "acquisition/self_light/patches.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <glm/geometric.hpp>

#include "engine/files/parallel_for.h"
#include "engine/surface/height_from_normals.h"
#include "shared/glsl.h"

namespace nacre {

namespace {

// 81 degrees: a wall that is steeper counts as one so steep, or a few pixels of a rim would light everything.
constexpr float kSteepestZ = 0.15f;
constexpr size_t kPatchesPerTask = 16;

// The sums become means once all pixels are in.
void addPixel(const NormalMap& normals, const Image& height, int x, int y, Patch& patch)
{
    const size_t pixel = normals.index(x, y);
    const glm::vec3& normal = normals.normals[pixel];
    patch.position += glm::vec3(x, -y, height.values[pixel]);
    patch.normal += normal;
    patch.area += 1 / std::max(normal.z, kSteepestZ);
}

// Whether the grid's heights rise above the ray between two patches by more than half a patch, which is how coarse they
// are.
class Occlusion {
public:
    explicit Occlusion(const PatchGrid& grid) : grid_(grid), places_(grid.patches.size())
    {
        for (size_t place = 0; place < grid.index.size(); ++place) {
            if (grid.index[place] >= 0) {
                places_[grid.index[place]] = {static_cast<int>(place) % grid.width,
                                              static_cast<int>(place) / grid.width};
            }
        }
    }

    bool isBlocked(size_t a, size_t b) const
    {
        const Place &from = places_[a], &to = places_[b];
        const int dx = to.x - from.x, dy = to.y - from.y, steps = std::max(std::abs(dx), std::abs(dy));
        const float start = grid_.patches[a].position.z, rise = grid_.patches[b].position.z - start;
        for (int step = 1; step < steps; ++step) {
            const float share = static_cast<float>(step) / static_cast<float>(steps);
            const int x = from.x + static_cast<int>(std::lround(share * static_cast<float>(dx))),
                      y = from.y + static_cast<int>(std::lround(share * static_cast<float>(dy)));
            const int between = grid_.index[static_cast<size_t>(y) * grid_.width + x];
            if (between >= 0 && grid_.patches[between].position.z > start + share * rise + 0.5f * kPatchSide) {
                return true;
            }
        }
        return false;
    }

private:
    struct Place {
        int x, y;
    };

    const PatchGrid& grid_;
    std::vector<Place> places_;
};

// Between small patches the form factor is cos cos' A' / (pi r^2); A in the denominator makes it that of a disc on its
// axis, which stays below 1 however near the disc is. The mean of both areas keeps A F = A' F'. 0 where they do not
// face each other.
glm::vec3 flowFrom(const Patch& sender, const Patch& receiver)
{
    const glm::vec3 way = sender.position - receiver.position;
    const float squared = glm::dot(way, way);
    if (!(squared > 0)) {
        return glm::vec3(0);
    }
    const glm::vec3 direction = way / std::sqrt(squared);
    const float leaving = -glm::dot(sender.normal, direction), arriving = glm::dot(receiver.normal, direction);
    if (leaving <= 0 || arriving <= 0) {
        return glm::vec3(0);
    }
    return direction * leaving * sender.area / (kPi * squared + 0.5f * (sender.area + receiver.area));
}

void limitToHemisphere(const Patch& receiver, std::vector<Passage>& passages)
{
    float sum = 0;
    for (const Passage& passage : passages) {
        sum += glm::dot(receiver.normal, passage.flow);
    }
    for (Passage& passage : passages) {
        passage.flow /= std::max(1.0f, sum);
    }
}

} // namespace

PatchGrid makePatches(const NormalMap& normals, int threads)
{
    const IntegratedHeight integrated = heightFromNormals(normals, {.threads = threads});
    PatchGrid grid;
    grid.width = (normals.width + kPatchSide - 1) / kPatchSide;
    grid.height = (normals.height + kPatchSide - 1) / kPatchSide;
    grid.index.assign(static_cast<size_t>(grid.width) * grid.height, -1);
    std::vector<float> counts;
    for (int y = 0; y < normals.height; ++y) {
        for (int x = 0; x < normals.width; ++x) {
            int& index = grid.index[static_cast<size_t>(y / kPatchSide) * grid.width + x / kPatchSide];
            if (normals.confidence[normals.index(x, y)] <= 0) {
                continue;
            }
            if (index < 0) {
                index = static_cast<int>(grid.patches.size());
                grid.patches.emplace_back();
                counts.push_back(0);
            }
            addPixel(normals, integrated.height, x, y, grid.patches[index]);
            ++counts[index];
        }
    }
    for (size_t i = 0; i < grid.patches.size(); ++i) {
        Patch& patch = grid.patches[i];
        patch.position /= counts[i];
        const float length = glm::length(patch.normal);
        patch.normal = length > 0 ? patch.normal / length : glm::vec3(0, 0, 1);
    }
    return grid;
}

std::vector<std::vector<Passage>> passagesBetween(const PatchGrid& grid, int threads)
{
    const Occlusion occlusion(grid);
    std::vector<std::vector<Passage>> all(grid.patches.size());
    parallelFor(all.size(), kPatchesPerTask, threads, [&](size_t first, size_t last) {
        for (size_t to = first; to < last; ++to) {
            for (size_t from = 0; from < all.size(); ++from) {
                const glm::vec3 flow = flowFrom(grid.patches[from], grid.patches[to]);
                if (flow != glm::vec3(0) && !occlusion.isBlocked(std::min(to, from), std::max(to, from))) {
                    all[to].push_back({static_cast<uint32_t>(from), flow});
                }
            }
            limitToHemisphere(grid.patches[to], all[to]);
        }
    });
    return all;
}

} // namespace nacre
