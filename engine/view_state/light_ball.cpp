#include "engine/view_state/light_ball.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace nacre {

glm::vec3 lightFromBallDisc(const glm::vec2& disc)
{
    const float reach = std::sin(kMostPolar), radius = glm::length(disc);
    const glm::vec2 inside = radius > reach ? disc * (reach / radius) : disc;
    return {inside.x, inside.y, std::sqrt(1 - glm::dot(inside, inside))};
}

glm::vec2 ballDiscFromLight(const glm::vec3& direction)
{
    const glm::vec3 unit = glm::normalize(direction);
    const glm::vec2 disc(unit);
    const float radius = glm::length(disc);
    return unit.z < 0 && radius > 0 ? disc / radius : disc;
}

glm::vec3 draggedLight(const glm::vec3& direction, const glm::vec2& moved)
{
    return lightFromBallDisc(ballDiscFromLight(direction) + moved);
}

LightAngles anglesOf(const glm::vec3& direction)
{
    return {glm::degrees(std::atan2(direction.y, direction.x)),
            glm::degrees(std::atan2(direction.z, glm::length(glm::vec2(direction))))};
}

glm::vec3 directionOf(const LightAngles& angles)
{
    const float azimuth = glm::radians(angles.azimuth), elevation = glm::radians(angles.elevation);
    return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

} // namespace nacre
