#pragma once
#include <memory>

#include <glm/vec3.hpp>

namespace nacre {

// The shading models of two exchange formats as sums of three coloured lobes: f = diffuse kD + specular kS + sheen kH +
// rest, the terms in 1/sr without the cosine, for directions in one frame. They are linear in the colours but for what
// the upper lobes take from the lower ones, so that fits can solve for colours.

// What a material looks like beside its colours.
struct LobeShape {
    float roughness = 0.5f;      // both formats: alpha = roughness^2
    float specularWeight = 1;    // glTF: what the lobe reflects at grazing angles, KHR_materials_specular's factor
    float ior = 1.5f;            // standard_surface alone; glTF's reflectance at normal incidence is kS
    float sheenRoughness = 0.3f; // where there is sheen
    // glTF: 0 to 1, where kS is its base colour if above 0; standard_surface: 0 or 1. kD then has no effect.
    float metallic = 0;

    bool isMetal() const { return metallic > 0; }
    bool operator==(const LobeShape&) const = default;
};

// In [0, 1] each. specular: the reflectance at normal incidence of glTF and of metals, else standard_surface's tint
// times its weight.
struct LobeColours {
    glm::vec3 diffuse{0};
    glm::vec3 specular{0};
    glm::vec3 sheen{0};
    bool operator==(const LobeColours&) const = default;
};

struct LobeTerms {
    glm::vec3 diffuse{0}, specular{0}, sheen{0}, rest{0};
};

class LobeModel {
public:
    virtual ~LobeModel() = default;
    // What the lobes take from each other is that of `colours`. l and v are above the horizon of n.
    virtual LobeTerms terms(const LobeColours& colours, const glm::vec3& n, const glm::vec3& l,
                            const glm::vec3& v) const = 0;

    // f; 0 below either horizon.
    glm::vec3 evaluate(const LobeColours& colours, const glm::vec3& n, const glm::vec3& l, const glm::vec3& v) const;
};

// glTF 2.0, Appendix B, with KHR_materials_specular and KHR_materials_sheen.
std::unique_ptr<LobeModel> gltfModel(const LobeShape& shape, bool hasSheen);

// MaterialX's standard_surface 1.0.1: GGX under a dielectric's or a metal's Fresnel reflectance above a diffuse part.
std::unique_ptr<LobeModel> standardSurfaceModel(const LobeShape& shape, bool hasSheen);

} // namespace nacre
