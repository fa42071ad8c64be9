#include "assets/synth/material_patches.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace nacre {
namespace {

constexpr int kPatches = 30;

// The spiral's axis is y, so that its uneven poles lie at the object's rim.
glm::dvec3 patchCentre(int i)
{
    const double y = 1 - (2 * i + 1) / static_cast<double>(kPatches);
    const double radius = std::sqrt(1 - y * y), azimuth = i * std::numbers::pi * (3 - std::sqrt(5.0));
    return {radius * std::cos(azimuth), y, radius * std::sin(azimuth)};
}

} // namespace

size_t patchMaterial(const glm::dvec3& direction, size_t materials)
{
    size_t nearest = 0;
    double closest = -2;
    for (int i = 0; i < kPatches; ++i) {
        const double cosine = glm::dot(direction, patchCentre(i));
        if (cosine > closest) {
            closest = cosine;
            nearest = static_cast<size_t>(i);
        }
    }
    return nearest % materials;
}

} // namespace nacre
