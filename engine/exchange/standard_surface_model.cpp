// Autodesk Standard Surface (Georgiev et al., 2019) as MaterialX defines it: libraries/bxdf/standard_surface.mtlx and
// the nodes that it is made of, in MaterialX Physically Based Shading Nodes, 1.39. Albedos of lobes are integrals here,
// where MaterialX leaves the method open.
#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

#include "engine/exchange/lobe_formulas.h"
#include "engine/exchange/lobe_model.h"
#include "shared/glsl.h"

namespace nacre {
namespace {

// Heitz, Understanding the Masking-Shadowing Function, 2014, eq. 99: G / (4 n.l n.v), height-correlated.
float correlatedVisibility(float alpha, const LobeCosines& c)
{
    const float a2 = alpha * alpha;
    const auto side = [a2](float cosine) { return std::sqrt(a2 + (1 - a2) * cosine * cosine); };
    return 0.5f / (c.nDotV * side(c.nDotL) + c.nDotL * side(c.nDotV));
}

// Unpolarised, of a dielectric (Cook, Torrance, 1982).
float dielectricReflectance(float ior, float cosine)
{
    const float g = std::sqrt(std::max(ior * ior - 1 + cosine * cosine, 0.0f)), a = (g - cosine) / (g + cosine),
                b = (cosine * (g + cosine) - 1) / (cosine * (g - cosine) + 1);
    return 0.5f * a * a * (1 + b * b);
}

// The metal of reflectance r at normal incidence and a white edge: artistic_ior (Gulbrandsen, Artist Friendly Metallic
// Fresnel, 2014, eqs. 1 to 5, g = 1) and conductor_bsdf's unpolarised reflectance.
float metalReflectance(float r, float cosine)
{
    r = std::clamp(r, 0.0f, 0.99f);
    const float n = (1 - r) / (1 + r);
    const float k2 = std::max((r * (n + 1) * (n + 1) - (n - 1) * (n - 1)) / (1 - r), 0.0f);
    const float sum = n * n + k2, c2 = cosine * cosine, nc = 2 * n * cosine;
    const float s = (sum + c2 - nc) / (sum + c2 + nc), p = (sum * c2 + 1 - nc) / (sum * c2 + 1 + nc);
    return 0.5f * (s + p);
}

// sheen_bsdf (Neubelt, Pettineo, Crafting a Next-Gen Material Pipeline for The Order: 1886, 2013).
float smoothSheen(float alpha, const LobeCosines& c)
{
    return charlie(alpha, c) / (4 * (c.nDotL + c.nDotV - c.nDotL * c.nDotV));
}

constexpr float kLeastSheen = 0.005f;      // sheen_bsdf's own bound
constexpr float kLeastReflectance = 1e-3f; // of metals: terms are divided by it

class StandardSurfaceModel : public LobeModel {
public:
    StandardSurfaceModel(const LobeShape& shape, bool hasSheen)
        : shape_(shape), hasSheen_(hasSheen), alpha_(shape.roughness * shape.roughness),
          sheenAlpha_(std::max(shape.sheenRoughness, kLeastSheen))
    {
        full_ = AlbedoByCosine([this](const LobeCosines& c) { return lobe(c); });
        if (!shape_.isMetal()) {
            const float r = (shape.ior - 1) / (shape.ior + 1), f0 = r * r;
            reflected_ =
                AlbedoByCosine([&](const LobeCosines& c) { return lobe(c) * glm::mix(f0, 1.0f, schlickShare(c)); });
        }
        if (hasSheen_) {
            sheenAlbedo_ = AlbedoByCosine([this](const LobeCosines& c) { return smoothSheen(sheenAlpha_, c); });
        }
    }

    LobeTerms terms(const LobeColours& colours, const glm::vec3& n, const glm::vec3& l,
                    const glm::vec3& v) const override
    {
        const LobeCosines c = lobeCosines(n, l, v);
        LobeTerms t = shape_.isMetal() ? metal(colours, c) : dielectric(colours, c);
        if (hasSheen_) {
            const float most = std::max({colours.sheen.x, colours.sheen.y, colours.sheen.z});
            const float left = 1 - most * std::min(sheenAlbedo_.at(c.nDotV), 1.0f);
            t.diffuse *= left, t.specular *= left;
            t.sheen = glm::vec3(smoothSheen(sheenAlpha_, c));
        }
        return t;
    }

private:
    float lobe(const LobeCosines& c) const { return ggx(alpha_, c) * correlatedVisibility(alpha_, c); }

    // Turquin, Practical multiple scattering compensation for microfacet models, 2019, eqs. 14 and 16.
    float compensation(const LobeCosines& c, float fresnel) const
    {
        const float e = std::max(full_.at(c.nDotV), 0.01f);
        return 1 + fresnel * (1 - e) / e;
    }

    LobeTerms metal(const LobeColours& colours, const LobeCosines& c) const
    {
        LobeTerms t;
        for (int i = 0; i < 3; ++i) {
            const float r = std::max(colours.specular[i], kLeastReflectance), f = metalReflectance(r, c.vDotH);
            t.specular[i] = lobe(c) * compensation(c, f) * f / r;
        }
        return t;
    }

    // dielectric_bsdf: the diffuse part has what the lobe leaves, by its weight and not by its tint.
    LobeTerms dielectric(const LobeColours& colours, const LobeCosines& c) const
    {
        const float f = dielectricReflectance(shape_.ior, c.vDotH), all = compensation(c, f);
        const float weight = std::max({colours.specular.x, colours.specular.y, colours.specular.z});
        LobeTerms t;
        t.specular = glm::vec3(lobe(c) * f * all);
        t.diffuse = glm::vec3(std::max(1 - weight * reflected_.at(c.nDotV) * all, 0.0f) / kPi);
        return t;
    }

    LobeShape shape_;
    bool hasSheen_;
    float alpha_, sheenAlpha_;
    AlbedoByCosine full_, reflected_, sheenAlbedo_;
};

} // namespace

std::unique_ptr<LobeModel> standardSurfaceModel(const LobeShape& shape, bool hasSheen)
{
    return std::make_unique<StandardSurfaceModel>(shape, hasSheen);
}

} // namespace nacre
