#include "engine/surface/residual_layer.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/lights/light_covariance.h"

namespace nacre {
namespace {

constexpr double kFadesFrom = 2, kFadesTo = 4; // of the lights' spacings
constexpr double kLeastSpacing = 0.02;         // lights that (nearly) coincide still reach a degree about them
constexpr double kMostSpacing = 0.25; // nothing is left a radius of the plane away, behind what faces the lights

// 1 up to the first distance, 0 from the second.
float presenceAt(double distance, double spacing)
{
    const double away = distance / std::clamp(spacing, kLeastSpacing, kMostSpacing);
    const double t = std::clamp((kFadesTo - away) / (kFadesTo - kFadesFrom), 0.0, 1.0);
    return static_cast<float>(t * t * (3 - 2 * t));
}

glm::vec4 radianceOf(const glm::vec3& weight, const Light& light)
{
    return {weight * light.irradiance, 0};
}

// Components' codes become radiance: low is in the offset, the range in the gain.
void addLight(const ResidualLayer& layer, const ResidualLight& at, const Light& light, ResidualWeights& weights)
{
    for (int k = 0; k < layer.components; ++k) {
        const glm::vec4 radiance = radianceOf(at.weights[k], light);
        weights.offset += radiance * layer.low[k];
        weights.gains[k] += radiance * (layer.high[k] - layer.low[k]);
    }
}

} // namespace

ResidualLights::ResidualLights(const ResidualLayer& layer)
    : layer_(layer), points_(lightPlanePoints(layer.nodes)), spacing_(meanSpacing(points_)), hull_(points_)
{
}

ResidualLight ResidualLights::at(const glm::vec3& direction) const
{
    const glm::vec2 point = lightPlanePoint(direction);
    ResidualLight light;
    light.presence = presenceAt(glm::length(point - hull_.nearest(point)), spacing_);
    light.trust = 1 - light.presence * (1 - layer_.trust);
    light.weights.assign(layer_.components, glm::vec3(0));
    if (light.presence == 0) {
        return light;
    }
    const size_t count = layer_.nodes.size();
    for (size_t i = 0; i < count; ++i) {
        const float covariance = light.presence * static_cast<float>(lightCovariance(direction, layer_.nodes[i]));
        for (int k = 0; k < layer_.components; ++k) {
            light.weights[k] += covariance * layer_.weights[k * count + i];
        }
    }
    return light;
}

ResidualFrame residualFrame(const ResidualLayer& layer, std::span<const Light> lights, ResidualUse use)
{
    ResidualFrame frame;
    frame.base.assign(lights.begin(), lights.end());
    if (layer.empty() || use == ResidualUse::off) {
        return frame;
    }
    const ResidualLights captured(layer);
    for (Light& light : frame.base) {
        const ResidualLight at = captured.at(light.direction);
        addLight(layer, at, light, frame.weights);
        light.irradiance *= use == ResidualUse::alone ? 0 : at.trust;
    }
    return frame;
}

glm::vec3 residualOfPixel(const ResidualLayer& layer, const ResidualWeights& weights, size_t pixel)
{
    glm::vec3 sum(weights.offset);
    for (size_t i = 0; i < layer.layers(); ++i) {
        const uint8_t* texel = &layer.codes[(i * layer.pixelCount() + pixel) * kComponentsPerTexel];
        for (int four = 0; four < kComponentsPerTexel; four += 4) {
            const uint8_t* codes = texel + four;
            const glm::vec4* gains = &weights.gains[i * kComponentsPerTexel + four];
            sum += residualOfFour(glm::vec4(codes[0], codes[1], codes[2], codes[3]) / 255.0f, gains[0], gains[1],
                                  gains[2], gains[3]);
        }
    }
    return sum;
}

ResidualLayer pickedResidual(const ResidualLayer& layer, const std::vector<int64_t>& from, int width, int height)
{
    if (layer.empty()) {
        return {};
    }
    ResidualLayer picked = layer;
    picked.width = width;
    picked.height = height;
    picked.codes.assign(layer.layers() * from.size() * kComponentsPerTexel, 0);
    for (size_t i = 0; i < layer.layers(); ++i) {
        for (size_t p = 0; p < from.size(); ++p) {
            if (from[p] >= 0) {
                std::copy_n(&layer.codes[(i * layer.pixelCount() + from[p]) * kComponentsPerTexel], kComponentsPerTexel,
                            &picked.codes[(i * from.size() + p) * kComponentsPerTexel]);
            }
        }
    }
    return picked;
}

size_t bytesOf(const ResidualLayer& layer)
{
    return layer.codes.size() + layer.weights.size() * sizeof(glm::vec3) + (layer.low.size() + layer.high.size()) * 4;
}

} // namespace nacre
