#include "acquisition/self_light/arriving_light.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/files/measures.h"

namespace nacre {

namespace {

constexpr float kFacing = 0.2f;          // n.l: at grazing light a normal's error is an error of the albedo
constexpr double kAlbedoQuantile = 0.75; // above shadows, below highlights

// The four nodes of a grid around a place, and their shares of it; node (0, 0) is at 0, nodes beyond the grid have
// none.
struct Corners {
    std::array<int, 4> nodes{};
    std::array<float, 4> shares{};
};

Corners cornersOf(float x, float y, int width, int height)
{
    const float left = std::floor(x), top = std::floor(y);
    Corners corners;
    for (int k = 0; k < 4; ++k) {
        const int column = static_cast<int>(left) + k % 2, row = static_cast<int>(top) + k / 2;
        if (column >= 0 && row >= 0 && column < width && row < height) {
            corners.nodes[k] = row * width + column;
            corners.shares[k] = (k % 2 == 1 ? x - left : 1 - x + left) * (k / 2 == 1 ? y - top : 1 - y + top);
        }
    }
    return corners;
}

} // namespace

Spot spotOf(const SelfLight& self, uint32_t pixel, int width)
{
    const int spacing = self.spacing;
    const float x = static_cast<float>(pixel % static_cast<uint32_t>(width)) + 0.5f,
                y = static_cast<float>(pixel / static_cast<uint32_t>(width)) + 0.5f;
    const auto placeOf = [](float pixels, int side) { return pixels / static_cast<float>(side) - 0.5f; };
    Spot spot{};
    const Corners nodes = cornersOf(placeOf(x, spacing), placeOf(y, spacing), self.normals.width, self.normals.height);
    for (int k = 0; k < 4; ++k) {
        spot.normal += nodes.shares[k] * self.normals.normals[nodes.nodes[k]];
    }
    const float length = glm::length(spot.normal);
    spot.normal = length > 0 ? spot.normal / length : glm::vec3(0);

    const Corners around = cornersOf(placeOf(x, spacing * kPatchSide), placeOf(y, spacing * kPatchSide),
                                     self.grid.width, self.grid.height);
    float sum = 0;
    for (int k = 0; k < 4; ++k) {
        const int patch = self.grid.index[around.nodes[k]];
        spot.patches[k] = std::max(patch, 0);
        spot.shares[k] = patch >= 0 ? around.shares[k] : 0.0f;
        sum += spot.shares[k];
    }
    for (float& share : spot.shares) {
        share = sum > 0 ? share / sum : 0.0f;
    }
    return spot;
}

void arrivingAt(const SelfLight& self, const Spot& spot, std::vector<glm::vec3>& arriving)
{
    arriving.assign(self.lightCount, glm::vec3(0));
    for (int k = 0; k < 4; ++k) {
        const glm::vec3 weighted = spot.shares[k] * spot.normal;
        const glm::mat3* light = &self.arriving[spot.patches[k] * self.lightCount];
        for (size_t i = 0; spot.shares[k] > 0 && i < self.lightCount; ++i) {
            arriving[i] += weighted * light[i];
        }
    }
    for (glm::vec3& each : arriving) {
        each = glm::max(each, glm::vec3(0));
    }
}

float selfLitAlbedo(std::span<const float> seen, std::span<const float> arriving, std::span<const float> cosines,
                    float strength)
{
    thread_local std::vector<float> albedos;
    albedos.clear();
    for (size_t i = 0; i < seen.size(); ++i) {
        if (cosines[i] > kFacing && !isClipped(seen[i])) {
            albedos.push_back(seen[i] / (cosines[i] + strength * arriving[i]));
        }
    }
    return albedos.empty() ? 0.0f : std::max(0.0f, quantile(albedos, kAlbedoQuantile));
}

} // namespace nacre
