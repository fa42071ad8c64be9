#pragma once
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

namespace nacre {

// What both formats' models share about a pair of directions above the horizon. Cosines are at least 1e-4, since
// models divide by them.
struct LobeCosines {
    float nDotL, nDotV, nDotH, sin2H, vDotH;
};
LobeCosines lobeCosines(const glm::vec3& n, const glm::vec3& l, const glm::vec3& v);

// Walter et al., Microfacet Models for Refraction through Rough Surfaces, 2007, eq. 33.
float ggx(float alpha, const LobeCosines& c);

// (1 - v.h)^5: Schlick, An Inexpensive BRDF Model for Physically-based Rendering, 1994.
float schlickShare(const LobeCosines& c);

// Estevez, Kulla, Production Friendly Microfacet Sheen BRDF, 2017, eq. 2; alpha is the exponent's inverse.
float charlie(float alpha, const LobeCosines& c);

// What a lobe without colour reflects of light from one side, integral f (n.l) dl, by the cosine of that side.
class AlbedoByCosine {
public:
    AlbedoByCosine() = default; // 0 everywhere
    explicit AlbedoByCosine(const std::function<float(const LobeCosines&)>& f);
    float at(float cosine) const;

private:
    std::vector<float> albedos_; // cosines evenly from 0 to 1
};

} // namespace nacre
