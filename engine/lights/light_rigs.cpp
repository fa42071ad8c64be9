#include "engine/lights/light_rigs.h"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/files/error.h"
#include "shared/brdf_coords.h"

namespace nacre {
namespace {

constexpr int kStudioWidth = 128; // pixels: 2.8 degrees, a tenth of the smallest soft box
constexpr int kStudioLights = 256;

Light lightFrom(const glm::vec3& direction, const glm::vec3& irradiance)
{
    return {glm::normalize(direction), irradiance};
}

// Polar angle from the view and azimuth from the right, degrees.
Light lightAt(float polar, float azimuth, const glm::vec3& irradiance)
{
    const float p = glm::radians(polar), a = glm::radians(azimuth);
    return lightFrom({std::sin(p) * std::cos(a), std::sin(p) * std::sin(a), std::cos(p)}, irradiance);
}

const Light kKey = lightAt(38, 137, glm::vec3(1));

std::vector<Light> ring()
{
    constexpr int kLights = 16;
    std::vector<Light> lights;
    for (int i = 0; i < kLights; ++i) {
        lights.push_back(lightAt(40, 360.0f * (static_cast<float>(i) + 0.5f) / kLights, glm::vec3(1.0f / kLights)));
    }
    return lights;
}

// A rectangle of light on the sphere of directions.
struct SoftBox {
    glm::vec3 towards;
    float halfWidth, halfHeight; // radians
    glm::vec3 radiance;
};

// 1 within, 0 outside, smooth over kEdge radians so that no box falls between pixels.
float insideOf(const SoftBox& box, const glm::vec3& direction)
{
    constexpr float kEdge = 0.05f;
    const glm::vec3 middle = glm::normalize(box.towards);
    const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), middle)), up = glm::cross(middle, right);
    const float depth = glm::dot(direction, middle);
    const auto within = [&](float across, float half) {
        return glm::clamp(0.5f + (half - std::abs(std::atan2(across, depth))) / kEdge, 0.0f, 1.0f);
    };
    return depth <= 0
               ? 0
               : within(glm::dot(direction, right), box.halfWidth) * within(glm::dot(direction, up), box.halfHeight);
}

glm::vec3 studioRadiance(const glm::vec3& direction)
{
    static const std::array<SoftBox, 3> kBoxes{{{{-0.8f, 0.35f, 0.5f}, 0.28f, 0.5f, glm::vec3(5.0f, 4.8f, 4.5f)},
                                                {{0.9f, 0.15f, 0.35f}, 0.16f, 0.6f, glm::vec3(2.2f, 2.5f, 2.9f)},
                                                {{0.1f, 0.9f, 0.4f}, 0.55f, 0.2f, glm::vec3(3.2f)}}};
    constexpr float kFloor = 0.06f, kCeiling = 0.35f;
    glm::vec3 radiance(kFloor + (kCeiling - kFloor) * (0.5f + 0.5f * direction.y));
    for (const SoftBox& box : kBoxes) {
        radiance += insideOf(box, direction) * box.radiance;
    }
    return radiance;
}

struct NamedRig {
    const char* name;
    std::vector<Light> (*lights)();
};

constexpr std::array<NamedRig, 5> kRigs{
    {{"key", [] { return std::vector<Light>{kKey}; }},
     {"three-point",
      [] {
          return std::vector<Light>{lightAt(38, 140, {1.0f, 0.88f, 0.72f}), lightAt(38, 10, {0.16f, 0.2f, 0.27f}),
                                    lightAt(82, 40, {0.6f, 0.66f, 0.75f})};
      }},
     {"raking", [] { return std::vector<Light>{lightAt(78, 170, glm::vec3(1))}; }},
     {"ring", ring},
     {"environment", [] { return lightsFromEnvironment(studioEnvironment(), kStudioLights); }}}};

} // namespace

std::vector<std::string> rigNames()
{
    std::vector<std::string> names;
    for (const NamedRig& rig : kRigs) {
        names.emplace_back(rig.name);
    }
    return names;
}

std::vector<Light> lightsOfRig(const std::string& name)
{
    for (const NamedRig& rig : kRigs) {
        if (name == rig.name) {
            return rig.lights();
        }
    }
    throw Error("", fmt::format("there is no rig \"{}\"", name), fmt::format("{}", fmt::join(rigNames(), ", ")),
                Error::kUsage);
}

Environment studioEnvironment()
{
    Image radiance(kStudioWidth, kStudioWidth / 2, 3);
    for (int y = 0; y < radiance.height; ++y) {
        for (int x = 0; x < radiance.width; ++x) {
            radiance.setRgb(x, y, studioRadiance(environmentDirection(radiance, x, y)));
        }
    }
    return {std::move(radiance)};
}

} // namespace nacre
