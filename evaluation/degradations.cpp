#include "evaluation/degradations.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "assets/hash_random.h"
#include "shared/glsl.h"

#include "shared/brdf_coords.h"

namespace nacre {

namespace {

// Keeps the random numbers of one degradation from those of another.
enum Stream : uint64_t { kShadows = 1, kNoise, kDirections, kIrradiances };

// Of every light, all lights by their angle to it, nearest first.
std::vector<std::vector<size_t>> neighboursOf(const std::vector<Light>& lights)
{
    std::vector<std::vector<size_t>> result(lights.size(), std::vector<size_t>(lights.size()));
    for (size_t i = 0; i < lights.size(); ++i) {
        std::iota(result[i].begin(), result[i].end(), size_t{0});
        std::stable_sort(result[i].begin(), result[i].end(), [&](size_t a, size_t b) {
            return glm::dot(lights[a].direction, lights[i].direction) >
                   glm::dot(lights[b].direction, lights[i].direction);
        });
    }
    return result;
}

} // namespace

void castShadows(Observations& seen, const std::vector<Light>& lights, double share, uint64_t seed)
{
    const std::vector<std::vector<size_t>> neighbours = neighboursOf(lights);
    const size_t blocked = static_cast<size_t>(std::lround(share * static_cast<double>(lights.size())));
    for (size_t p = 0; p < seen.pixels.size(); ++p) {
        const std::vector<size_t>& order = neighbours[hashOf(hashOf(seed, kShadows), seen.pixels[p]) % lights.size()];
        for (size_t k = 0; k < blocked; ++k) {
            seen.radiance[p * seen.lightCount + order[k]] = glm::vec3(0);
            seen.saturated[p * seen.lightCount + order[k]] = 0;
        }
    }
}

void addNoise(Observations& seen, double share, uint64_t seed)
{
    const double deviation = share * valueQuantile(seen, 0.99);
    for (size_t k = 0; k < seen.radiance.size(); ++k) {
        for (int c = 0; c < 3; ++c) {
            const uint64_t key = hashOf(hashOf(seed, kNoise), 3 * k + c);
            seen.radiance[k][c] += static_cast<float>(deviation * gaussianFromHash(key));
        }
    }
}

void overexpose(Observations& seen, double share)
{
    const float fullScale = valueQuantile(seen, 1 - share);
    for (size_t k = 0; k < seen.radiance.size(); ++k) {
        const glm::vec3 cut = glm::min(seen.radiance[k], glm::vec3(fullScale));
        seen.saturated[k] |= cut != seen.radiance[k];
        seen.radiance[k] = cut;
    }
}

void quantise(Observations& seen, int bits)
{
    const float step = valueQuantile(seen, 1) / static_cast<float>((1 << bits) - 1);
    for (glm::vec3& radiance : seen.radiance) {
        radiance = step * glm::round(glm::max(radiance, glm::vec3(0)) / step);
    }
}

void turnDirections(std::vector<Light>& lights, double degrees, uint64_t seed)
{
    const float angle = glm::radians(static_cast<float>(degrees));
    for (size_t i = 0; i < lights.size(); ++i) {
        glm::vec3& d = lights[i].direction;
        const glm::vec3 u = anyPerpendicular(d), v = glm::cross(d, u);
        const float side = 2 * kPi * static_cast<float>(unitFromHash(hashOf(hashOf(seed, kDirections), i)));
        d = glm::normalize(std::cos(angle) * d + std::sin(angle) * (std::cos(side) * u + std::sin(side) * v));
    }
}

void misjudgeIrradiances(std::vector<Light>& lights, double deviation, uint64_t seed)
{
    for (size_t i = 0; i < lights.size(); ++i) {
        const double drawn = gaussianFromHash(hashOf(hashOf(seed, kIrradiances), i));
        lights[i].irradiance *= static_cast<float>(std::exp(deviation * drawn));
    }
}

PhotographedObject degraded(PhotographedObject object, const Degradation& degradation)
{
    const uint64_t seed = degradation.seed;
    if (degradation.shadowShare > 0) {
        castShadows(object.seen, object.lights, degradation.shadowShare, seed);
    }
    if (degradation.noise > 0) {
        addNoise(object.seen, degradation.noise, seed);
    }
    if (degradation.overexposedShare > 0) {
        overexpose(object.seen, degradation.overexposedShare);
    }
    if (degradation.bits > 0) {
        quantise(object.seen, degradation.bits);
    }
    if (degradation.directionErrorDegrees > 0) {
        turnDirections(object.lights, degradation.directionErrorDegrees, seed);
    }
    if (degradation.irradianceError > 0) {
        misjudgeIrradiances(object.lights, degradation.irradianceError, seed);
    }
    return object;
}

} // namespace nacre
