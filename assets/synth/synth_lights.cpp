#include "assets/synth/synth_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "assets/synth/hash_random.h"

namespace nacre {
namespace {

// Share of the spacing between lights by which each is moved: uneven, as placed by hand, yet none falls on another.
constexpr double kJitter = 0.3;
constexpr double kGoldenAngle = std::numbers::pi * (3.0 - 2.2360679774997896);

// Area-preserving: height on the cap and azimuth are both uniform.
glm::vec3 directionOnCap(double heightFromTop, double azimuth)
{
    double z = 1.0 - heightFromTop;
    double s = std::sqrt(std::max(0.0, 1.0 - z * z));
    return {s * std::cos(azimuth), s * std::sin(azimuth), z};
}

} // namespace

std::vector<Light> synthLights(const SynthOptions& options)
{
    const double capHeight = 1.0 - std::cos(options.capDegrees * std::numbers::pi / 180.0);
    const double spread = options.largestIrradiance - options.leastIrradiance;
    std::vector<Light> lights(options.lights);
    for (int i = 0; i < options.lights; ++i) {
        auto random = [&](uint64_t which) { return unitFromHash(hashOf(hashOf(options.seed, i), which)); };
        double step = (i + 0.5 + kJitter * (random(0) - 0.5)) / options.lights;
        double azimuth = (i + kJitter * (random(1) - 0.5)) * kGoldenAngle;
        lights[i].direction = directionOnCap(capHeight * step, azimuth);
        for (int c = 0; c < 3; ++c) {
            lights[i].irradiance[c] = static_cast<float>(options.leastIrradiance + spread * random(2 + c));
        }
    }
    return lights;
}

} // namespace nacre
