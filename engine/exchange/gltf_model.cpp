// Khronos Group, glTF 2.0 Specification, Appendix B: BRDF Implementation, with the extensions KHR_materials_specular
// and KHR_materials_sheen. Renderers may differ: the specification asks for its look, not for its formulas.
#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

#include "engine/exchange/lobe_formulas.h"
#include "engine/exchange/lobe_model.h"
#include "shared/glsl.h"

namespace nacre {
namespace {

float largestOf(const glm::vec3& v)
{
    return std::max({v.x, v.y, v.z});
}

// V = G / (4 n.l n.v), B.3.1: the separable form of Smith's masking and shadowing.
float separableVisibility(float alpha, const LobeCosines& c)
{
    const float a2 = alpha * alpha;
    const auto side = [a2](float cosine) { return cosine + std::sqrt(a2 + (1 - a2) * cosine * cosine); };
    return 1 / (side(c.nDotL) * side(c.nDotV));
}

// KHR_materials_sheen, "Sheen visibility": Estevez and Kulla's fit of Smith's Lambda for their distribution.
float sheenLambda(float cosine, float alpha)
{
    const float t = (1 - alpha) * (1 - alpha);
    const float a = glm::mix(21.5473f, 25.3245f, t), b = glm::mix(3.82987f, 3.32435f, t),
                c = glm::mix(0.19823f, 0.16801f, t), d = glm::mix(-1.97760f, -1.27393f, t),
                e = glm::mix(-4.32054f, -4.85967f, t);
    const auto l = [&](float x) { return a / (1 + b * std::pow(x, c)) + d * x + e; };
    return std::exp(cosine < 0.5f ? l(cosine) : 2 * l(0.5f) - l(1 - cosine));
}

float sheenOf(float alpha, const LobeCosines& c)
{
    const float visibility =
        1 / ((1 + sheenLambda(c.nDotV, alpha) + sheenLambda(c.nDotL, alpha)) * 4 * c.nDotV * c.nDotL);
    return charlie(alpha, c) * visibility;
}

// Below, the sheen's distribution has no width that anyone draws (the extension: implementations clamp it).
constexpr float kLeastSheenAlpha = 0.005f;

constexpr float kDielectricF0 = 0.04f; // of index of refraction 1.5

class GltfModel : public LobeModel {
public:
    GltfModel(const LobeShape& shape, bool hasSheen)
        : shape_(shape), hasSheen_(hasSheen), alpha_(shape.roughness * shape.roughness),
          sheenAlpha_(std::max(shape.sheenRoughness * shape.sheenRoughness, kLeastSheenAlpha))
    {
        if (hasSheen_) {
            sheenAlbedo_ = AlbedoByCosine([this](const LobeCosines& c) { return sheenOf(sheenAlpha_, c); });
        }
    }

    // fresnel_mix and conductor_fresnel: F = w (f0 + (1 - f0) (1 - v.h)^5), kS being w f0; the diffuse part has what
    // the strongest channel of it leaves.
    LobeTerms terms(const LobeColours& colours, const glm::vec3& n, const glm::vec3& l,
                    const glm::vec3& v) const override
    {
        const LobeCosines c = lobeCosines(n, l, v);
        const float share = schlickShare(c), lobe = ggx(alpha_, c) * separableVisibility(alpha_, c);
        const float m = shape_.metallic, grazing = shape_.specularWeight;
        LobeTerms t;
        if (shape_.isMetal()) { // mix(dielectric_brdf, metal_brdf, metallic) of one colour
            const float fresnel = kDielectricF0 + (1 - kDielectricF0) * share;
            t.specular = glm::vec3((1 - m) * (1 - fresnel) / kPi + m * lobe * (1 - share));
            t.rest = glm::vec3(lobe * ((1 - m) * fresnel + m * share));
        } else {
            const float fresnel = largestOf(colours.specular) * (1 - share) + share * grazing;
            t.diffuse = glm::vec3((1 - fresnel) / kPi);
            t.specular = glm::vec3(lobe * (1 - share));
            t.rest = glm::vec3(lobe * share * grazing);
        }
        if (hasSheen_) {
            const float most = largestOf(colours.sheen);
            const float left = 1 - most * std::max(sheenAlbedo_.at(c.nDotV), sheenAlbedo_.at(c.nDotL));
            t.diffuse *= left, t.specular *= left, t.rest *= left;
            t.sheen = glm::vec3(sheenOf(sheenAlpha_, c));
        }
        return t;
    }

private:
    LobeShape shape_;
    bool hasSheen_;
    float alpha_, sheenAlpha_;
    AlbedoByCosine sheenAlbedo_;
};

} // namespace

std::unique_ptr<LobeModel> gltfModel(const LobeShape& shape, bool hasSheen)
{
    return std::make_unique<GltfModel>(shape, hasSheen);
}

} // namespace nacre
