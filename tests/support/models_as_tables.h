#pragma once
#include <cmath>

#include "engine/brdf/brdf_models.h"

namespace nacre {

// Tangent-frame direction of polar angle and azimuth, radians.
inline glm::vec3 tangentDirection(double theta, double phi)
{
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

inline BrdfModel modelOf(BrdfTable table)
{
    return std::make_shared<const BrdfTable>(std::move(table));
}

} // namespace nacre
