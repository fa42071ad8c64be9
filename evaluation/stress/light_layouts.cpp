#include "evaluation/stress/light_layouts.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "shared/glsl.h"

#include "shared/brdf_coords.h"

namespace nacre {

namespace {

constexpr float kArcDegrees = 55;
// Of the arc against the picture's rows, so that nothing rests on the axes.
constexpr float kArcTurnDegrees = 25;

glm::vec3 onSphere(float polar, float azimuth)
{
    return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
}

// Polar angles from one end of an arc to the other, in radians.
float alongArc(size_t i, size_t count)
{
    return glm::radians(kArcDegrees) * (2 * (static_cast<float>(i) + 0.5f) / static_cast<float>(count) - 1);
}

// `along` from the view within the plane of the arc, `beside` out of that plane.
glm::vec3 arcDirection(float along, float beside, float turn)
{
    const float x = std::cos(beside) * std::sin(along), y = std::sin(beside);
    return {std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y,
            std::cos(beside) * std::cos(along)};
}

} // namespace

// Vogel, A better way to construct the sunflower head, 1979, with heights in place of squared radii.
std::vector<Light> spreadLights(size_t count, double capDegrees, const glm::vec3& centre)
{
    const float goldenAngle = kPi * (3 - std::sqrt(5.0f));
    const float height = 1 - std::cos(glm::radians(static_cast<float>(capDegrees)));
    const glm::vec3 u = -anyPerpendicular(centre), v = glm::cross(centre, u);
    std::vector<Light> lights(count);
    for (size_t i = 0; i < count; ++i) {
        const float z = 1 - height * (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
        const glm::vec3 d = onSphere(std::acos(z), goldenAngle * static_cast<float>(i));
        lights[i].direction = glm::normalize(d.x * u + d.y * v + d.z * centre);
    }
    return lights;
}

std::vector<Light> ringLights(size_t count, double polarDegrees)
{
    std::vector<Light> lights(count);
    for (size_t i = 0; i < count; ++i) {
        const float azimuth = 2 * kPi * static_cast<float>(i) / static_cast<float>(count);
        lights[i].direction = onSphere(glm::radians(static_cast<float>(polarDegrees)), azimuth);
    }
    return lights;
}

std::vector<Light> arcLights(size_t count, double besideDegrees)
{
    const float beside = glm::radians(static_cast<float>(besideDegrees));
    std::vector<Light> lights(count);
    for (size_t i = 0; i < count; ++i) {
        lights[i].direction =
            arcDirection(alongArc(i, count), i % 2 == 0 ? beside : -beside, glm::radians(kArcTurnDegrees));
    }
    return lights;
}

std::vector<Light> crossedLights(size_t count)
{
    std::vector<Light> lights(count);
    const size_t half = (count + 1) / 2;
    for (size_t i = 0; i < count; ++i) {
        const bool second = i >= half;
        const float turn = glm::radians(kArcTurnDegrees) + (second ? kPi / 2 : 0.0f);
        lights[i].direction = arcDirection(second ? alongArc(i - half, count - half) : alongArc(i, half), 0, turn);
    }
    return lights;
}

} // namespace nacre
