// Half-difference coordinates of many normals under one light: with l and v fixed, thetaD and the half vector h are
// constants, and the normal's polar angle and azimuth about h ARE thetaH and phiD. Three dot products a light replace
// the cross products of brdf_coords.h's general formula.
#ifndef NACRE_LIGHT_FRAME_H
#define NACRE_LIGHT_FRAME_H
#include "brdf_coords.h"
NACRE_SHARED_BEGIN

struct LightFrame {
    vec4 half_;      // xyz unit, between l and v; w = cos(thetaD)
    vec4 tangent;    // xyz unit, perpendicular to it, on l's side in the plane of l and v; w = sin(thetaD)
    vec4 across;     // xyz unit, perpendicular to both; w = thetaD in radians
    vec4 irradiance; // rgb on a plane facing the light; w = 1, or 0 where l = v leaves phiD undefined
};

// l and v unit and not opposite.
NACRE_FN LightFrame lightFrame(vec3 l, vec3 v, vec3 irradiance)
{
    vec3 sum = l + v;
    vec3 difference = l - v;
    float sumLength = max(length(sum), 1e-12f);
    float differenceLength = length(difference);
    vec3 h = sum / sumLength;
    bool apart = differenceLength > 1e-6f;
    vec3 t = apart ? difference / differenceLength : anyPerpendicular(h);
    LightFrame f;
    float thetaD = atan(differenceLength, sumLength);
    f.half_ = vec4(h, cos(thetaD));
    f.tangent = vec4(t, sin(thetaD));
    f.across = vec4(cross(h, t), thetaD);
    f.irradiance = vec4(irradiance, apart ? 1.0f : 0.0f);
    return f;
}

// The normal in the frame: x along tangent, y along across, z along half_.
NACRE_FN vec3 normalInFrame(LightFrame f, vec3 n)
{
    return vec3(dot(n, vec3(f.tangent)), dot(n, vec3(f.across)), dot(n, vec3(f.half_)));
}

NACRE_FN vec3 lightDirection(LightFrame f)
{
    return f.half_.w * vec3(f.half_) + f.tangent.w * vec3(f.tangent);
}

// n.l of a normal in the frame.
NACRE_FN float cosineInFrame(LightFrame f, vec3 m)
{
    return f.half_.w * m.z + f.tangent.w * m.x;
}

// atan(y, x) for y >= 0 and x >= 0, in [0, pi/2]. Least-squares fit of atan(a)/a on [0, 1], weighted to even its
// largest relative error out: 7e-7.
NACRE_FN float quadrantAtan(float y, float x)
{
    float a = min(x, y) / max(max(x, y), 1e-30f);
    float s = a * a;
    float p = 0.00786271189f;
    p = p * s - 0.0370112255f;
    p = p * s + 0.0838693959f;
    p = p * s - 0.134871055f;
    p = p * s + 0.198814627f;
    p = p * s - 0.33326513f;
    p = p * s + 0.999999347f;
    float r = a * p;
    return y > x ? kHalfPi - r : r;
}

// unitFromHalfDifference of a normal in the frame. The axis x of brdf_coords.h points from n to h, so that phiD is 0
// where the normal leans away from the light, and pi where towards it. A normal below the half vector's horizon (z < 0,
// under lights that it does not see) answers as one on it.
NACRE_FN vec3 unitInFrame(LightFrame f, vec3 m, TableDomain domain)
{
    float sine = sqrt(m.x * m.x + m.y * m.y);
    float thetaH = quadrantAtan(sine, max(m.z, 0.0f));
    float phiD = quadrantAtan(abs(m.y), abs(m.x));
    if (domain.coordinates == kOneWay && m.x > 0.0f) {
        phiD = kPi - phiD;
    }
    return vec3(sqrt(thetaH / kHalfPi), min(f.across.w / domain.thetaDMax, 1.0f),
                f.irradiance.w * phiD / largestPhiD(domain.coordinates));
}

NACRE_SHARED_END
#endif
