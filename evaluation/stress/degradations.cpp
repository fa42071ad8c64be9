#include "evaluation/stress/degradations.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/files/hash_random.h"
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

void bringLightsNear(PhotographedObject& object, double widths)
{
    const size_t n = object.lights.size();
    const std::vector<uint32_t>& pixels = object.seen.pixels;
    glm::vec2 least(1e9f), most(-1e9f);
    const auto placeOf = [&](uint32_t pixel) {
        return glm::vec2(static_cast<float>(pixel % object.width), -static_cast<float>(pixel / object.width));
    };
    for (const uint32_t pixel : pixels) {
        least = glm::min(least, placeOf(pixel));
        most = glm::max(most, placeOf(pixel));
    }
    const glm::vec2 middle = 0.5f * (least + most);
    const float distance = static_cast<float>(widths) * std::max(most.x - least.x, most.y - least.y);
    for (size_t p = 0; p < pixels.size(); ++p) {
        const glm::vec3 place(placeOf(pixels[p]) - middle, 0), normal = object.truth.normals[p];
        for (size_t i = 0; i < n; ++i) {
            const glm::vec3 far = object.lights[i].direction, towards = distance * far - place;
            const float nDotL = glm::dot(normal, far), length = glm::length(towards);
            if (nDotL > 0) {
                object.seen.radiance[p * n + i] *= std::max(0.0f, glm::dot(normal, towards) / length) / nDotL *
                                                   (distance * distance) / (length * length);
            }
        }
    }
}

void bendTransfer(Observations& seen, double exponent)
{
    const float fullScale = valueQuantile(seen, 1), power = static_cast<float>(1 / exponent);
    for (glm::vec3& radiance : seen.radiance) {
        radiance = fullScale * glm::pow(glm::max(radiance, glm::vec3(0)) / fullScale, glm::vec3(power));
    }
}

void misplaceSphere(std::vector<Light>& lights, double shareOfRadius)
{
    const glm::vec3 view(0, 0, 1);
    const float shift = static_cast<float>(shareOfRadius) * std::sqrt(0.5f);
    for (Light& light : lights) {
        const glm::vec3 highlight = glm::normalize(light.direction + view);
        const glm::vec2 read = glm::vec2(highlight) - shift;
        const glm::vec3 normal(read, std::sqrt(std::max(0.0f, 1 - glm::dot(read, read))));
        light.direction = glm::normalize(2 * glm::dot(normal, view) * normal - view);
    }
}

void flipUpwards(std::vector<Light>& lights)
{
    for (Light& light : lights) {
        light.direction.y = -light.direction.y;
    }
}

PhotographedObject degraded(PhotographedObject object, const Degradation& degradation)
{
    const uint64_t seed = degradation.seed;
    if (degradation.nearWidths > 0) {
        bringLightsNear(object, degradation.nearWidths);
    }
    if (degradation.shadowShare > 0) {
        castShadows(object.seen, object.lights, degradation.shadowShare, seed);
    }
    if (degradation.noise > 0) {
        addNoise(object.seen, degradation.noise, seed);
    }
    if (degradation.overexposedShare > 0) {
        overexpose(object.seen, degradation.overexposedShare);
    }
    if (degradation.transferExponent != 1) {
        bendTransfer(object.seen, degradation.transferExponent);
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
    if (degradation.sphereShift > 0) {
        for (const Light& light : object.lights) {
            object.shadingDirections.push_back(light.direction);
        }
        misplaceSphere(object.lights, degradation.sphereShift);
    }
    if (degradation.flipped) {
        flipUpwards(object.lights);
    }
    return object;
}

} // namespace nacre
