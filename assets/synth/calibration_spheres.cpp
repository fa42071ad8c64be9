#include "assets/synth/calibration_spheres.h"

#include <cmath>
#include <numbers>

#include <glm/vec2.hpp>

#include "shared/brdf_coords.h"
#include "shared/shading.h"

namespace nacre {
namespace {

// Radius of the light's disc as seen from the sphere [radians]: a lamp of 10 cm at 1.5 m.
constexpr double kLightRadius = 2.0 * std::numbers::pi / 180.0;

// Samples a pixel's side: the highlight's rim is some pixels wide and its middle must not depend on the grid.
constexpr int kSubsamples = 4;

// In sphere radii from its middle, y up; x and y in pixels from the top left corner.
glm::dvec2 discPoint(int size, double x, double y)
{
    double radius = 0.5 * kSphereShare * size;
    return {(x - 0.5 * size) / radius, (0.5 * size - y) / radius};
}

// False beside the sphere.
bool sphereNormal(const glm::dvec2& p, vec3& n)
{
    double rest = 1.0 - p.x * p.x - p.y * p.y;
    if (rest < 0.0) {
        return false;
    }
    n = vec3(p.x, p.y, std::sqrt(rest));
    return true;
}

template <class Radiance> Image sampledSphere(int size, int subsamples, const Radiance& radianceOf)
{
    Image picture(size, size, 3);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            vec3 sum(0);
            for (int s = 0; s < subsamples * subsamples; ++s) {
                double dx = (s % subsamples + 0.5) / subsamples;
                double dy = (s / subsamples + 0.5) / subsamples;
                vec3 n;
                if (sphereNormal(discPoint(size, x + dx, y + dy), n)) {
                    sum += radianceOf(n);
                }
            }
            picture.setRgb(x, y, sum / static_cast<float>(subsamples * subsamples));
        }
    }
    return picture;
}

} // namespace

std::vector<uint8_t> calibrationSphereMask(int size)
{
    Image inside = sampledSphere(size, 1, [](const vec3&) { return vec3(1); });
    std::vector<uint8_t> mask(inside.pixelCount());
    for (size_t i = 0; i < mask.size(); ++i) {
        mask[i] = inside.values[3 * i] > 0.0f;
    }
    return mask;
}

Image diffuseSphereRadiance(int size, const glm::vec3& reflectance, const Light& light)
{
    return sampledSphere(size, 1, [&](const vec3& n) {
        return radianceFromBrdf(reflectance / kPi, light.irradiance, dot(n, light.direction));
    });
}

Image mirrorSphereRadiance(int size, const Light& light, double roomRadiance)
{
    const double sine = std::sin(kLightRadius);
    const vec3 discRadiance = light.irradiance / static_cast<float>(std::numbers::pi * sine * sine);
    const vec3 room(static_cast<float>(roomRadiance));
    return sampledSphere(size, kSubsamples, [&](const vec3& n) {
        vec3 mirrored = 2.0f * n.z * n - vec3(0, 0, 1); // of the view (0,0,1)
        return angleBetween(mirrored, light.direction) < kLightRadius ? discRadiance : room;
    });
}

} // namespace nacre
