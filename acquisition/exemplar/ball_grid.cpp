#include "acquisition/exemplar/ball_grid.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/brdf/brdf_table.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr float kRimRadius = 0.9999f; // of the disc; n.z > 0
constexpr float kTexelsBeyond = 1.5f;
constexpr size_t kRowsPerTask = 64;

glm::vec2 discOfTexel(const glm::vec2& texel, int size)
{
    const float texels = static_cast<float>(size);
    return {2 * (texel.x + 0.5f) / texels - 1, 1 - 2 * (texel.y + 0.5f) / texels};
}

} // namespace

// With r = sqrt(2) sin(theta / 2) over the rim's 1: z = cos(theta) = 1 - r^2 and (x, y) = d sqrt(2 - r^2).
glm::vec3 normalOfBallTexel(const glm::vec2& texel, int size)
{
    glm::vec2 disc = discOfTexel(texel, size);
    const float radius = glm::length(disc);
    if (radius > kRimRadius) {
        disc *= kRimRadius / radius;
    }
    const float squared = glm::dot(disc, disc);
    return glm::normalize(glm::vec3(disc * std::sqrt(2 - squared), 1 - squared));
}

glm::vec2 ballTexelOf(const glm::vec3& normal, int size)
{
    const glm::vec2 disc = glm::vec2(normal) / std::sqrt(1 + std::max(normal.z, 0.0f));
    const float texels = static_cast<float>(size);
    return {(disc.x + 1) / 2 * texels - 0.5f, (1 - disc.y) / 2 * texels - 0.5f};
}

float halfBinOf(float cosThetaH)
{
    const float theta = std::acos(std::clamp(cosThetaH, -1.0f, 1.0f));
    return kHalfBins * std::sqrt(theta / (static_cast<float>(kPi) / 2));
}

float differenceBinOf(float cosThetaD, float largestThetaD)
{
    return kDifferenceBins * std::acos(std::clamp(cosThetaD, -1.0f, 1.0f)) / largestThetaD;
}

float thetaHOfBin(int bin)
{
    const float share = (static_cast<float>(bin) + 0.5f) / kHalfBins;
    return share * share * static_cast<float>(kPi) / 2;
}

int BallGrid::rowAt(const glm::vec2& texel) const
{
    const int x = static_cast<int>(std::lround(texel.x)), y = static_cast<int>(std::lround(texel.y));
    const bool isInside = x >= 0 && y >= 0 && x < size && y < size;
    return isInside ? rows[static_cast<size_t>(y) * size + x] : -1;
}

BallGrid makeBallGrid(int size, const std::vector<Light>& lights, int threads)
{
    BallGrid grid;
    grid.size = size;
    grid.lightCount = lights.size();
    grid.stride = (lights.size() + 7) / 8 * 8;
    grid.rows.assign(static_cast<size_t>(size) * size, -1);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const glm::vec2 texel(x, y);
            if (glm::length(discOfTexel(texel, size)) < 1 + 2 * kTexelsBeyond / static_cast<float>(size)) {
                grid.rows[static_cast<size_t>(y) * size + x] = static_cast<int>(grid.normals.size());
                grid.normals.push_back(normalOfBallTexel(texel, size));
            }
        }
    }
    for (const Light& light : lights) {
        grid.directions.push_back(light.direction);
        grid.halves.push_back(glm::normalize(light.direction + glm::vec3(0, 0, 1)));
        grid.largestThetaD = std::max(grid.largestThetaD, std::acos(std::clamp(grid.halves.back().z, -1.0f, 1.0f)));
    }
    grid.largestThetaD += 1e-3f; // so that the largest lies in the last bin, and one light alone has a bin
    grid.cosines.assign(grid.normals.size() * grid.stride, 0.0f);
    grid.halfBins.assign(grid.cosines.size(), 0.0f);
    parallelFor(grid.normals.size(), kRowsPerTask, threads, [&](size_t first, size_t last) {
        for (size_t row = first; row < last; ++row) {
            for (size_t i = 0; i < lights.size(); ++i) {
                const size_t at = row * grid.stride + i;
                grid.cosines[at] = std::max(0.0f, glm::dot(grid.normals[row], grid.directions[i]));
                grid.halfBins[at] =
                    std::clamp(halfBinOf(glm::dot(grid.normals[row], grid.halves[i])) - 0.5f, 0.0f, kHalfBins - 1.001f);
            }
        }
    });
    return grid;
}

Between between(float place, int knots)
{
    const float last = static_cast<float>(knots) - 1, clamped = std::clamp(place, 0.0f, last);
    const int knot = std::min(static_cast<int>(clamped), knots - 2);
    return {knot, clamped - static_cast<float>(knot), place > 0 && place < last};
}

std::vector<LightPlace> lightPlaces(const BallGrid& grid)
{
    std::vector<LightPlace> places;
    for (size_t i = 0; i < grid.lightCount; ++i) {
        const float place = std::clamp(differenceBinOf(grid.halves[i].z, grid.largestThetaD) - 0.5f, 0.0f,
                                       static_cast<float>(kDifferenceBins - 1));
        const int bin = std::min(static_cast<int>(place), kDifferenceBins - 2);
        places.push_back({grid.directions[i], grid.halves[i], bin, place - static_cast<float>(bin)});
    }
    return places;
}

} // namespace nacre
