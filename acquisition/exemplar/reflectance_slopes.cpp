#include "acquisition/exemplar/reflectance_slopes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

namespace nacre {

namespace {

constexpr double kLeastLobe = 1e-6;
// The slope of a root is infinite at 0: it is taken here at least.
constexpr float kLeastRoot = 0.03f;

// T where a normal's thetaH meets a light's thetaD: four texels, bilinearly.
struct LobeAt {
    std::array<int, 4> texels{};
    std::array<float, 4> weights{};
    float value = 0, byCosine = 0; // by cos(thetaH)
};

LobeAt lobeAt(const std::vector<float>& lobe, const LightPlace& light, float cosHalf)
{
    const float place = halfBinOf(cosHalf) - 0.5f;
    const Between half = between(place, kHalfBins);
    const int first = half.knot * kDifferenceBins + light.difference;
    const float next = light.nextShare;
    LobeAt at;
    at.texels = {first, first + 1, first + kDifferenceBins, first + kDifferenceBins + 1};
    at.weights = {(1 - half.share) * (1 - next), (1 - half.share) * next, half.share * (1 - next), half.share * next};
    for (int k = 0; k < 4; ++k) {
        at.value += at.weights[k] * lobe[at.texels[k]];
    }
    if (half.isInside) {
        // Bins go with sqrt(thetaH): d bin / d thetaH = bin / (2 thetaH), and d thetaH / d cos = -1 / sin.
        const float theta = std::acos(std::clamp(cosHalf, -1.0f, 1.0f));
        const float byBin =
            (1 - next) * (lobe[at.texels[2]] - lobe[at.texels[0]]) + next * (lobe[at.texels[3]] - lobe[at.texels[1]]);
        at.byCosine = -byBin * (place + 0.5f) / (2 * theta * std::max(std::sin(theta), 1e-4f));
    }
    return at;
}

// With an albedo of the pixel's own.
RootSlopes ownSlopes(const SlopedReflectance& sloped, const PixelGuess& guess, const NormalBasis& basis, float bright,
                     const LightPlace& light)
{
    const Reflectance& reflectance = sloped.reflectance;
    const float cosine = glm::dot(guess.normal, light.direction), scale = std::exp(guess.logScale);
    RootSlopes result;
    if (cosine <= 0) {
        result.root = std::sqrt(scale * reflectance.bounced);
        result.byPixel[2] = result.root / 2;
        return result;
    }
    const LobeAt lobe = lobeAt(reflectance.lobe, light, glm::dot(guess.normal, light.half));
    const Between knot = between(cosine * (kShadeKnots - 1), kShadeKnots);
    // w and its derivatives by n.l and by n.v.
    const std::vector<float>& coupling = reflectance.coupling;
    const CouplingPlace place = coupling.empty() ? CouplingPlace{} : couplingPlace(cosine, guess.normal.z, light);
    float coupled = 0, coupledByL = 0, coupledByV = 0;
    for (size_t k = 0; k < 8 && !coupling.empty(); ++k) {
        const float w = coupling[place.knots[k]];
        coupled += place.weights[k] * w;
        coupledByL += place.slopesByL[k] * w;
        coupledByV += place.slopesByV[k] * w;
    }
    const float shade = std::exp(reflectance.shadeAt(cosine) + coupled),
                shadeSlope =
                    (reflectance.shade[knot.knot + 1] - reflectance.shade[knot.knot]) * (kShadeKnots - 1) + coupledByL;
    // What is shown, a p + b a, and its derivatives by n.l, cos(thetaH), log a, T and u.
    float value, byCosine, byHalf, byScale, byLobe, byShade;
    if (reflectance.additive) {
        const float matte = scale * shade * cosine, gloss = lobe.value * cosine / bright;
        const bool isAll = matte + gloss > kLeastGlossShare * matte;
        const float share = isAll ? 1.0f : kLeastGlossShare, glossy = isAll ? 1 / bright : 0.0f;
        byScale = byShade = share * matte;
        value = byScale + glossy * lobe.value * cosine;
        byCosine = share * scale * shade * (1 + cosine * shadeSlope) + glossy * lobe.value;
        byHalf = glossy * lobe.byCosine * cosine;
        byLobe = glossy * cosine;
    } else {
        byLobe = scale * shade * cosine;
        value = byScale = byShade = byLobe * lobe.value;
        byCosine = scale * lobe.value * shade * (1 + cosine * shadeSlope);
        byHalf = byLobe * lobe.byCosine;
    }
    value += scale * reflectance.bounced;
    byScale += scale * reflectance.bounced;
    result.root = std::sqrt(value);
    const float half = 0.5f / std::max(result.root, kLeastRoot); // d sqrt(v) = dv / 2 sqrt(v)
    const auto byStep = [&](const glm::vec3& step) {
        return half * (byCosine * glm::dot(step, light.direction) + byHalf * glm::dot(step, light.half) +
                       byShade * coupledByV * step.z);
    };
    result.byPixel = {byStep(basis.across), byStep(basis.along), half * byScale};
    for (int k = 0; k < 4; ++k) {
        result.unknowns[k] = lobe.texels[k];
        result.byUnknown[k] = half * byLobe * lobe.weights[k] * sloped.lobeSlopes[lobe.texels[k]];
    }
    result.unknowns[4] = kShadeUnknowns + knot.knot;
    result.byUnknown[4] = half * byShade * (1 - knot.share);
    result.unknowns[5] = kShadeUnknowns + knot.knot + 1;
    result.byUnknown[5] = half * byShade * knot.share;
    result.count = 6;
    for (size_t k = 0; k < 8 && !coupling.empty(); ++k) {
        result.unknowns[result.count] = kCouplingUnknowns + place.knots[k];
        result.byUnknown[result.count++] = half * byShade * place.weights[k];
    }
    return result;
}

} // namespace

Eigen::VectorXd unknownsOf(const Reflectance& reflectance, float unit)
{
    const int coupled = static_cast<int>(reflectance.coupling.size());
    Eigen::VectorXd unknowns(kCouplingUnknowns + coupled);
    for (int k = 0; k < kLobeUnknowns; ++k) {
        const double value = reflectance.lobe[k];
        unknowns[k] = reflectance.additive ? std::asinh(value / unit) : std::log(std::max(value, kLeastLobe));
    }
    for (int k = 0; k < kShadeKnots; ++k) {
        unknowns[kShadeUnknowns + k] = reflectance.shade[k];
        unknowns[kSlantUnknowns + k] = reflectance.slant[k];
    }
    for (int k = 0; k < coupled; ++k) {
        unknowns[kCouplingUnknowns + k] = reflectance.coupling[k];
    }
    return unknowns;
}

SlopedReflectance reflectanceOf(const Eigen::VectorXd& unknowns, float unit, const Reflectance& like)
{
    SlopedReflectance result{like, std::vector<float>(kLobeUnknowns)};
    for (int k = 0; k < kLobeUnknowns; ++k) {
        const double z = unknowns[k];
        result.reflectance.lobe[k] = static_cast<float>(like.additive ? unit * std::sinh(z) : std::exp(z));
        result.lobeSlopes[k] = static_cast<float>(like.additive ? unit * std::cosh(z) : std::exp(z));
    }
    for (int k = 0; k < kShadeKnots; ++k) {
        result.reflectance.shade[k] = static_cast<float>(unknowns[kShadeUnknowns + k]);
        result.reflectance.slant[k] = static_cast<float>(unknowns[kSlantUnknowns + k]);
    }
    for (size_t k = 0; k < like.coupling.size(); ++k) {
        result.reflectance.coupling[k] = static_cast<float>(unknowns[kCouplingUnknowns + static_cast<int>(k)]);
    }
    return result;
}

NormalBasis basisOf(const glm::vec3& normal)
{
    const glm::vec3 aside = std::abs(normal.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 across = glm::normalize(glm::cross(aside, normal));
    return {across, glm::cross(normal, across)};
}

RootSlopes rootSlopes(const SlopedReflectance& sloped, const PixelGuess& guess, const NormalBasis& basis, float bright,
                      const LightPlace& light)
{
    const Reflectance& reflectance = sloped.reflectance;
    if (!reflectance.oneAlbedo) {
        return ownSlopes(sloped, guess, basis, bright, light);
    }
    // log scale = log a - log bright + v(n.v): what depended on it does so by the normal and by v's two knots.
    const float nDotV = guess.normal.z;
    const PixelGuess scaled{guess.pixel, guess.normal,
                            std::log(*reflectance.oneAlbedo / bright) + reflectance.slantAt(nDotV)};
    RootSlopes result = ownSlopes(sloped, scaled, basis, bright, light);
    const float byScale = std::exchange(result.byPixel[2], 0.0f);
    const Between knot = between(nDotV * (kShadeKnots - 1), kShadeKnots);
    const float slope = (reflectance.slant[knot.knot + 1] - reflectance.slant[knot.knot]) * (kShadeKnots - 1);
    result.byPixel[0] += byScale * slope * basis.across.z;
    result.byPixel[1] += byScale * slope * basis.along.z;
    for (int k = 0; k < 2; ++k) {
        result.unknowns[result.count] = kSlantUnknowns + knot.knot + k;
        result.byUnknown[result.count] = byScale * (k == 0 ? 1 - knot.share : knot.share);
        ++result.count;
    }
    return result;
}

} // namespace nacre
