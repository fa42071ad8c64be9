// Coordinates of an isotropic BRDF, their inverses, and the grid of a baked table.
// All directions are unit and point away from the surface: n normal, l towards the light, v towards the viewer.
// Angles are in radians. Every mapping stands next to its inverse.
#ifndef NACRE_BRDF_COORDS_H
#define NACRE_BRDF_COORDS_H
#include "glsl.h"
NACRE_SHARED_BEGIN

// Half-difference coordinates (Rusinkiewicz, A New Change of Variables for Efficient BRDF Representation, 1998).
struct HalfDifference {
    float thetaH; // between n and the half vector h, [0, pi/2]
    float thetaD; // between h and l, [0, pi/2]
    float phiD;   // azimuth of l about h, measured from the plane of n and h, (-pi, pi]; 0 where undefined
};

// Natural coordinates: the polar angles of both directions and the azimuth between them.
struct Natural {
    float thetaI; // between n and l, [0, pi/2]
    float thetaO; // between n and v, [0, pi/2]
    float phi;    // azimuth from v to l about n, (-pi, pi]; 0 where undefined
};

// A pair of directions in the tangent frame, whose z is the normal.
struct LightView {
    vec3 l;
    vec3 v;
};

// The angle between unit vectors, accurate near 0 where acos(dot) is wrong by percents in float.
NACRE_FN float angleBetween(vec3 a, vec3 b)
{
    return atan(length(cross(a, b)), dot(a, b));
}

// A unit vector perpendicular to unit a, for frames whose azimuth is arbitrary.
NACRE_FN vec3 anyPerpendicular(vec3 a)
{
    return abs(a.x) < 0.5f ? normalize(vec3(0.0f, a.z, -a.y)) : normalize(vec3(-a.z, 0.0f, a.x));
}

NACRE_FN vec3 rotatedAboutY(vec3 a, float angle)
{
    float c = cos(angle);
    float s = sin(angle);
    return vec3(c * a.x + s * a.z, a.y, c * a.z - s * a.x);
}

// d = R_y(-thetaH) R_z(-phiH) l has the axes x = y x h and y = n x h / |n x h| in any frame, so no frame is built.
// l and v must not be opposite (h would be undefined).
NACRE_FN HalfDifference halfDifferenceFromDirections(vec3 n, vec3 l, vec3 v)
{
    vec3 sum = l + v;
    vec3 h = sum / max(length(sum), 1e-12f);
    vec3 nCrossH = cross(n, h);
    float sinThetaH = length(nCrossH);
    HalfDifference c;
    c.thetaH = atan(sinThetaH, dot(n, h));
    c.thetaD = atan(length(l - v), length(sum));
    c.phiD = 0.0f;
    if (sinThetaH > 0.0f && c.thetaD > 0.0f) {
        vec3 y = nCrossH / sinThetaH;
        vec3 x = cross(y, h);
        float dx = dot(l, x);
        float dy = dot(l, y);
        if (dx != 0.0f || dy != 0.0f) {
            c.phiD = atan(dy, dx);
        }
    }
    return c;
}

// Tangent-frame directions with phiH = 0.
NACRE_FN LightView directionsFromHalfDifference(HalfDifference c)
{
    float s = sin(c.thetaD);
    vec3 d = vec3(s * cos(c.phiD), s * sin(c.phiD), cos(c.thetaD));
    LightView r;
    r.l = rotatedAboutY(d, c.thetaH);
    r.v = rotatedAboutY(vec3(-d.x, -d.y, d.z), c.thetaH);
    return r;
}

NACRE_FN Natural naturalFromDirections(vec3 n, vec3 l, vec3 v)
{
    Natural c;
    c.thetaI = angleBetween(n, l);
    c.thetaO = angleBetween(n, v);
    vec3 vTangent = v - n * dot(n, v);
    vec3 lTangent = l - n * dot(n, l);
    float cosine = dot(vTangent, lTangent);
    float sine = dot(n, cross(vTangent, lTangent));
    c.phi = (cosine != 0.0f || sine != 0.0f) ? atan(sine, cosine) : 0.0f;
    return c;
}

// Tangent-frame directions with v in the plane of x and z.
NACRE_FN LightView directionsFromNatural(Natural c)
{
    float s = sin(c.thetaI);
    LightView r;
    r.l = vec3(s * cos(c.phi), s * sin(c.phi), cos(c.thetaI));
    r.v = vec3(sin(c.thetaO), 0.0f, cos(c.thetaO));
    return r;
}

// Which coordinates a table is baked in; the values are numbers in pages and shaders, names in files.
const int kHalfDifference = 0; // of a reciprocal BRDF, f(l, v) = f(v, l)
const int kNatural = 1;
const int kOneWay = 2; // half-difference, f(l, v) and f(v, l) in texels of their own

// The part of the coordinates that a table spans.
struct TableDomain {
    int coordinates; // kHalfDifference, kNatural or kOneWay
    float thetaDMax; // all but natural: largest thetaD on the grid, (0, pi/2]
};

// Mirror symmetry of isotropic materials takes phiD to -phiD, reciprocity takes it to phiD + pi: together [0, pi/2].
NACRE_FN float largestPhiD(int coordinates)
{
    return coordinates == kOneWay ? kPi : kHalfPi;
}

NACRE_FN float foldedPhiD(float phiD, int coordinates)
{
    float a = abs(phiD);
    return coordinates == kOneWay ? a : min(a, kPi - a);
}

// Half-difference to the unit cube: the square root spends the texels on the highlight (MERL's mapping,
// Matusik et al., A Data-Driven Reflectance Model, 2003). What lies beyond thetaDMax is clamped to the border.
NACRE_FN vec3 unitFromHalfDifference(HalfDifference c, TableDomain domain)
{
    float phiD = foldedPhiD(c.phiD, domain.coordinates);
    return clamp(
        vec3(sqrt(max(c.thetaH, 0.0f) / kHalfPi), c.thetaD / domain.thetaDMax, phiD / largestPhiD(domain.coordinates)),
        0.0f, 1.0f);
}

NACRE_FN HalfDifference halfDifferenceFromUnit(vec3 unit, TableDomain domain)
{
    HalfDifference c;
    c.thetaH = unit.x * unit.x * kHalfPi;
    c.thetaD = unit.y * domain.thetaDMax;
    c.phiD = unit.z * largestPhiD(domain.coordinates);
    return c;
}

// Natural to the unit cube; mirror symmetry folds phi to [0, pi].
NACRE_FN vec3 unitFromNatural(Natural c)
{
    return clamp(vec3(c.thetaI / kHalfPi, c.thetaO / kHalfPi, abs(c.phi) / kPi), 0.0f, 1.0f);
}

NACRE_FN Natural naturalFromUnit(vec3 unit)
{
    Natural c;
    c.thetaI = unit.x * kHalfPi;
    c.thetaO = unit.y * kHalfPi;
    c.phi = unit.z * kPi;
    return c;
}

NACRE_FN vec3 unitFromDirections(TableDomain domain, vec3 n, vec3 l, vec3 v)
{
    if (domain.coordinates == kNatural) {
        return unitFromNatural(naturalFromDirections(n, l, v));
    }
    return unitFromHalfDifference(halfDifferenceFromDirections(n, l, v), domain);
}

NACRE_FN LightView directionsFromUnit(TableDomain domain, vec3 unit)
{
    if (domain.coordinates == kNatural) {
        return directionsFromNatural(naturalFromUnit(unit));
    }
    return directionsFromHalfDifference(halfDifferenceFromUnit(unit, domain));
}

// Half texels: 0 and 1 map to the centres of the first and the last texel. Texture coordinates in [0, 1].
NACRE_FN vec3 texelFromUnit(vec3 unit, vec3 size)
{
    return (unit * (size - 1.0f) + 0.5f) / size;
}

NACRE_FN vec3 unitFromTexel(vec3 texel, vec3 size)
{
    return (texel * size - 0.5f) / max(size - 1.0f, vec3(1.0f));
}

NACRE_SHARED_END
#endif
