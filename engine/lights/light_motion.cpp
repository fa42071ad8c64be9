#include "engine/lights/light_motion.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "shared/brdf_coords.h"

namespace nacre {
namespace {

glm::vec3 rotatedAboutZ(const glm::vec3& a, float angle)
{
    const float c = std::cos(angle), s = std::sin(angle);
    return {c * a.x - s * a.y, s * a.x + c * a.y, a.z};
}

} // namespace

std::vector<Light> softLight(const Light& light, float radius, int count)
{
    constexpr float kGoldenAngle = 2.3999632f; // radians
    const glm::vec3 x = anyPerpendicular(light.direction), y = glm::cross(light.direction, x);
    std::vector<Light> lights;
    for (int i = 0; i < count; ++i) {
        const float z = 1 - (1 - std::cos(radius)) * (i + 0.5f) / count; // equal areas of the cap
        const float r = std::sqrt(1 - z * z), azimuth = kGoldenAngle * i;
        const glm::vec3 direction = z * light.direction + r * (std::cos(azimuth) * x + std::sin(azimuth) * y);
        lights.push_back({glm::normalize(direction), light.irradiance / static_cast<float>(count), light.distance});
    }
    return lights;
}

std::vector<Light> movedLights(std::span<const Light> lights, LightMotion motion, int frame, int frames)
{
    std::vector<Light> moved(lights.begin(), lights.end());
    const float turn = 2 * kPi * static_cast<float>(frame) / static_cast<float>(frames);
    const float along = frames > 1 ? static_cast<float>(frame) / static_cast<float>(frames - 1) : 0.5f;
    for (Light& light : moved) {
        if (motion == LightMotion::turntable && frame > 0) {
            light.direction = glm::normalize(rotatedAboutZ(light.direction, turn));
        } else if (motion == LightMotion::sweep) {
            light.direction = glm::normalize(rotatedAboutY(light.direction, kSweepReach * (2 * along - 1)));
        }
    }
    return moved;
}

} // namespace nacre
