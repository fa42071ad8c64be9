#include "engine/brdf/brdf_models.h"

#include "engine/brdf/rgl_brdf.h"
#include "shared/brdf_coords.h"

namespace nacre {
namespace {

// What the models share about one pair of directions above the horizon.
struct Configuration {
    float nDotL, nDotV; // (0,1], floored: see kGrazingFloor
    float cosThetaH, sin2ThetaH;
    float cosThetaD; // h.l = h.v
};

// Cosine of 89.994 degrees. Microfacet models divide by n.l and n.v; below this the quotient is held finite.
constexpr float kGrazingFloor = 1e-4f;

// sin^2 comes from the cross product: 1 - cos^2 in float is wrong by percents near the highlight.
Configuration configurationOf(const vec3& n, const vec3& l, const vec3& v)
{
    vec3 sum = l + v;
    vec3 h = sum / max(length(sum), 1e-12f);
    vec3 nCrossH = cross(n, h);
    return {max(dot(n, l), kGrazingFloor), max(dot(n, v), kGrazingFloor), clamp(dot(n, h), kGrazingFloor, 1.0f),
            min(dot(nCrossH, nCrossH), 1.0f), clamp(dot(h, l), 0.0f, 1.0f)};
}

float fifthPower(float x)
{
    return x * x * x * x * x;
}

// Schlick, An Inexpensive BRDF Model for Physically-based Rendering, 1994. No real surface has F0 below 2 %: less is
// read as shadowed and fades the grazing reflection too (Lagarde and de Rousiers, Moving Frostbite to PBR, 2014), so
// that F0 = 0 is Lambert alone.
vec3 schlickFresnel(const vec3& F0, float cosThetaD)
{
    vec3 F90 = clamp(50.0f * F0, 0.0f, 1.0f);
    return F0 + (F90 - F0) * fifthPower(1.0f - cosThetaD);
}

// Walter et al., Microfacet Models for Refraction through Rough Surfaces, 2007, eq. 33.
float ggxDistribution(float alpha, const Configuration& c)
{
    float a2 = alpha * alpha;
    float denominator = c.cosThetaH * c.cosThetaH * a2 + c.sin2ThetaH;
    return a2 / (kPi * denominator * denominator);
}

// G / (4 n.l n.v) of the height-correlated Smith term (Heitz, Understanding the Masking-Shadowing Function, 2014, eq.
// 99).
float smithVisibility(float alpha, const Configuration& c)
{
    float a2 = alpha * alpha;
    float l = c.nDotV * sqrt(c.nDotL * c.nDotL * (1.0f - a2) + a2);
    float v = c.nDotL * sqrt(c.nDotV * c.nDotV * (1.0f - a2) + a2);
    return 0.5f / (l + v);
}

vec3 evaluateModel(const LambertGgx& m, const Configuration& c)
{
    float DV = ggxDistribution(m.alpha, c) * smithVisibility(m.alpha, c);
    return m.diffuse / kPi + schlickFresnel(m.specular, c.cosThetaD) * DV;
}

// Unpolarised reflectance of a dielectric (Cook and Torrance, A Reflectance Model for Computer Graphics, 1982).
float dielectricFresnel(float ior, float cosThetaD)
{
    float c = cosThetaD;
    float g = sqrt(max(ior * ior - 1.0f + c * c, 0.0f));
    float a = (g - c) / (g + c);
    float b = (c * (g + c) - 1.0f) / (c * (g - c) + 1.0f);
    return 0.5f * a * a * (1.0f + b * b);
}

// The symmetric V-groove's shadowing (Torrance and Sparrow, 1967).
float vGrooveShadowing(const Configuration& c)
{
    float least = min(c.nDotL, c.nDotV);
    return min(1.0f, 2.0f * c.cosThetaH * least / max(c.cosThetaD, kGrazingFloor));
}

vec3 evaluateModel(const AbcModel& m, const Configuration& c)
{
    float oneMinusCos = c.sin2ThetaH / (1.0f + c.cosThetaH);
    vec3 D = m.A / pow(1.0f + m.B * oneMinusCos, m.C);
    float FG = dielectricFresnel(m.ior, c.cosThetaD) * vGrooveShadowing(c);
    return m.kD / kPi + D * (FG / (kPi * c.nDotL * c.nDotV));
}

// Shadowing fitted per channel: 1 up to theta0, then falling.
float sgdShadowing(const SgdModel& m, int channel, float theta)
{
    float beyond = max(theta - m.theta0[channel], 0.0f);
    float fall = 1.0f - exp(m.c[channel] * pow(beyond, m.k[channel]));
    return clamp(1.0f + m.lambda[channel] * fall, 0.0f, 1.0f);
}

float sgdDistribution(const SgdModel& m, int channel, const Configuration& c)
{
    float alpha = m.alpha[channel];
    float cos2 = c.cosThetaH * c.cosThetaH;
    float x = alpha + c.sin2ThetaH / (cos2 * alpha);
    return m.kap[channel] * exp(-x) / (kPi * pow(x, m.p[channel]) * cos2 * cos2);
}

// The fits' F0 and F1 are free parameters that may leave [0,1]; a negative reflectance is cut off.
float sgdFresnel(const SgdModel& m, int channel, float cosThetaD)
{
    float F0 = m.F0[channel];
    return max(0.0f, F0 - cosThetaD * m.F1[channel] + (1.0f - F0) * fifthPower(1.0f - cosThetaD));
}

vec3 evaluateModel(const SgdModel& m, const Configuration& c)
{
    float thetaL = acos(min(c.nDotL, 1.0f));
    float thetaV = acos(min(c.nDotV, 1.0f));
    vec3 f;
    for (int channel = 0; channel < 3; ++channel) {
        float G = sgdShadowing(m, channel, thetaL) * sgdShadowing(m, channel, thetaV);
        float DFG = sgdDistribution(m, channel, c) * sgdFresnel(m, channel, c.cosThetaD) * G;
        f[channel] = (m.rhoD[channel] + m.rhoS[channel] * DFG / (c.nDotL * c.nDotV)) / kPi;
    }
    return f;
}

template <class Parametric> vec3 evaluateModel(const Parametric& m, const vec3& n, const vec3& l, const vec3& v)
{
    return evaluateModel(m, configurationOf(n, l, v));
}

vec3 evaluateModel(const std::shared_ptr<const BrdfTable>& table, const vec3& n, const vec3& l, const vec3& v)
{
    return evaluateTable(*table, n, l, v).value;
}

vec3 evaluateModel(const std::shared_ptr<const RglBrdf>& material, const vec3& n, const vec3& l, const vec3& v)
{
    const vec3 x = anyPerpendicular(n), y = cross(n, x);
    return material->evaluate(vec3(dot(l, x), dot(l, y), dot(l, n)), vec3(dot(v, x), dot(v, y), dot(v, n)));
}

// Rounding may put a texel at the domain's edge a little beyond it.
constexpr float kDomainTolerance = 1e-4f; // radians

} // namespace

vec3 evaluate(const BrdfModel& model, const vec3& n, const vec3& l, const vec3& v)
{
    if (dot(n, l) <= 0.0f || dot(n, v) <= 0.0f) {
        return vec3(0);
    }
    return std::visit([&](const auto& m) { return evaluateModel(m, n, l, v); }, model);
}

BrdfValue evaluateCovered(const BrdfModel& model, const vec3& n, const vec3& l, const vec3& v)
{
    if (dot(n, l) <= 0.0f || dot(n, v) <= 0.0f) {
        return {vec3(0), 0};
    }
    const BrdfTable* table = tableOf(model);
    if (!table) {
        return {evaluate(model, n, l, v), 1};
    }
    BrdfValue value = evaluateTable(*table, n, l, v);
    if (table->domain.coordinates != kNatural &&
        halfDifferenceFromDirections(n, l, v).thetaD > table->domain.thetaDMax + kDomainTolerance) {
        value.confidence = 0;
    }
    return value;
}

const BrdfTable* tableOf(const BrdfModel& model)
{
    const auto* table = std::get_if<std::shared_ptr<const BrdfTable>>(&model);
    return table ? table->get() : nullptr;
}

} // namespace nacre
