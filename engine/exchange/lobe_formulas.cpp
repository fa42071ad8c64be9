#include "engine/exchange/lobe_formulas.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/exchange/lobe_model.h"
#include "shared/glsl.h"

namespace nacre {
namespace {

constexpr float kLeastLobeCosine = 1e-4f;
constexpr int kAlbedoCosines = 24, kAlbedoRings = 48, kAlbedoSpokes = 24;

float fifthPowerOf(float x)
{
    return x * x * x * x * x;
}

} // namespace

glm::vec3 LobeModel::evaluate(const LobeColours& colours, const glm::vec3& n, const glm::vec3& l,
                              const glm::vec3& v) const
{
    if (glm::dot(n, l) <= 0 || glm::dot(n, v) <= 0) {
        return glm::vec3(0);
    }
    const LobeTerms t = terms(colours, n, l, v);
    return t.diffuse * colours.diffuse + t.specular * colours.specular + t.sheen * colours.sheen + t.rest;
}

LobeCosines lobeCosines(const glm::vec3& n, const glm::vec3& l, const glm::vec3& v)
{
    const glm::vec3 sum = l + v, h = sum / std::max(glm::length(sum), 1e-12f), side = glm::cross(n, h);
    const auto cosine = [](float x) { return std::clamp(x, kLeastLobeCosine, 1.0f); };
    return {cosine(glm::dot(n, l)), cosine(glm::dot(n, v)), cosine(glm::dot(n, h)),
            std::min(glm::dot(side, side), 1.0f), cosine(glm::dot(v, h))};
}

// sin^2 by the cross product, since 1 - cos^2 in float is off by percents near the highlight.
float ggx(float alpha, const LobeCosines& c)
{
    const float a2 = alpha * alpha, d = c.nDotH * c.nDotH * a2 + c.sin2H;
    return a2 / (kPi * d * d);
}

float schlickShare(const LobeCosines& c)
{
    return fifthPowerOf(1 - c.vDotH);
}

float charlie(float alpha, const LobeCosines& c)
{
    return (2 + 1 / alpha) * std::pow(c.sin2H, 0.5f / alpha) / (2 * kPi);
}

// Rings of equal shares of the projected hemisphere, over half the azimuths, the other half being alike.
AlbedoByCosine::AlbedoByCosine(const std::function<float(const LobeCosines&)>& f)
{
    for (int i = 0; i < kAlbedoCosines; ++i) {
        const float z = std::max(static_cast<float>(i) / (kAlbedoCosines - 1), 0.01f);
        const glm::vec3 n(0, 0, 1), v(std::sqrt(1 - z * z), 0, z);
        double sum = 0;
        for (int ring = 0; ring < kAlbedoRings; ++ring) {
            const float sine = std::sqrt((ring + 0.5f) / kAlbedoRings), cosine = std::sqrt(1 - sine * sine);
            for (int spoke = 0; spoke < kAlbedoSpokes; ++spoke) {
                const float phi = kPi * (spoke + 0.5f) / kAlbedoSpokes;
                sum += f(lobeCosines(n, {sine * std::cos(phi), sine * std::sin(phi), cosine}, v));
            }
        }
        albedos_.push_back(static_cast<float>(kPi * sum / (kAlbedoRings * kAlbedoSpokes)));
    }
}

float AlbedoByCosine::at(float cosine) const
{
    if (albedos_.empty()) {
        return 0;
    }
    const float x = std::clamp(cosine, 0.0f, 1.0f) * (kAlbedoCosines - 1);
    const int i = std::min(static_cast<int>(x), kAlbedoCosines - 2);
    return glm::mix(albedos_[i], albedos_[i + 1], x - static_cast<float>(i));
}

} // namespace nacre
