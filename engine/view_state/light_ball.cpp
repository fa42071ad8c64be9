#include "engine/view_state/light_ball.h"

#include <cmath>

#include <glm/geometric.hpp>

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

} // namespace nacre
