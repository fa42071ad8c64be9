#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "shared/ball.h"
#include "shared/brdf_coords.h"
#include "shared/shading.h"

namespace nacre {
namespace {

vec3 polar(float theta, float phi)
{
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// Directions over the hemisphere: the pole, near it, and grazing.
std::vector<vec3> hemisphere()
{
    std::vector<vec3> directions;
    for (const float theta : {0.0f, 1e-4f, 0.01f, 0.3f, 0.8f, 1.2f, 1.5f, 1.57f}) {
        for (int k = 0; k < 8; ++k) {
            directions.push_back(polar(theta, 0.1f + 0.785f * k));
        }
    }
    return directions;
}

// A pair of directions up to a rotation about n: what an isotropic BRDF may depend on.
void expectSameConfiguration(vec3 n, vec3 l, vec3 v, const LightView& tangent, float signedSide)
{
    const float tolerance = 1e-5f;
    EXPECT_NEAR(dot(n, l), tangent.l.z, tolerance);
    EXPECT_NEAR(dot(n, v), tangent.v.z, tolerance);
    EXPECT_NEAR(dot(l, v), dot(tangent.l, tangent.v), tolerance);
    EXPECT_NEAR(signedSide, dot(vec3(0, 0, 1), cross(tangent.v, tangent.l)), tolerance);
}

TEST(BrdfCoords, HalfDifferenceRoundTripGrazingAndCoincidentIncluded)
{
    const vec3 n = normalize(vec3(0.3f, -0.4f, 0.8f));
    const vec3 x = anyPerpendicular(n), y = cross(n, x);
    for (const vec3& lt : hemisphere()) {
        for (const vec3& vt : hemisphere()) {
            const vec3 l = lt.x * x + lt.y * y + lt.z * n, v = vt.x * x + vt.y * y + vt.z * n;
            if (length(l + v) < 0.02f) {
                continue; // opposite directions have no half vector; its error is 1e-7 / |l + v|
            }
            const HalfDifference c = halfDifferenceFromDirections(n, l, v);
            expectSameConfiguration(n, l, v, directionsFromHalfDifference(c), dot(n, cross(v, l)));
        }
    }
}

TEST(BrdfCoords, NaturalRoundTripGrazingAndCoincidentIncluded)
{
    const vec3 n = normalize(vec3(-0.5f, 0.2f, 0.7f));
    const vec3 x = anyPerpendicular(n), y = cross(n, x);
    for (const vec3& lt : hemisphere()) {
        for (const vec3& vt : hemisphere()) {
            const vec3 l = lt.x * x + lt.y * y + lt.z * n, v = vt.x * x + vt.y * y + vt.z * n;
            expectSameConfiguration(n, l, v, directionsFromNatural(naturalFromDirections(n, l, v)),
                                    dot(n, cross(v, l)));
        }
    }
}

TEST(BrdfCoords, AnglesOfKnownConfigurations)
{
    const vec3 n(0, 0, 1);
    const HalfDifference mirror = halfDifferenceFromDirections(n, polar(0.5f, 0), polar(0.5f, kPi));
    EXPECT_NEAR(mirror.thetaH, 0, 1e-6f);
    EXPECT_NEAR(mirror.thetaD, 0.5f, 1e-6f);
    const HalfDifference back = halfDifferenceFromDirections(n, polar(0.7f, 1), polar(0.7f, 1));
    EXPECT_NEAR(back.thetaH, 0.7f, 1e-6f);
    EXPECT_EQ(back.thetaD, 0);
    EXPECT_EQ(back.phiD, 0);
    // Light and view in one plane with the normal, light further out: l lies on the far side of h.
    const HalfDifference plane = halfDifferenceFromDirections(n, polar(0.9f, 0), polar(0.1f, 0));
    EXPECT_NEAR(plane.thetaH, 0.5f, 1e-6f);
    EXPECT_NEAR(plane.thetaD, 0.4f, 1e-6f);
    EXPECT_NEAR(plane.phiD, 0, 1e-6f);
    const Natural natural = naturalFromDirections(n, polar(0.9f, 2.0f), polar(0.2f, 0.5f));
    EXPECT_NEAR(natural.thetaI, 0.9f, 1e-6f);
    EXPECT_NEAR(natural.thetaO, 0.2f, 1e-6f);
    EXPECT_NEAR(natural.phi, 1.5f, 1e-6f);
}

TEST(BrdfCoords, ThetaHIsAccurateNextToTheHighlight)
{
    // acos(n.h) in float is 0 or 3.5e-4 here; the angle is wanted to 1 %.
    for (const float angle : {1e-4f, 3e-4f, 1e-3f}) {
        const vec3 l = polar(2 * angle, 0.3f);
        EXPECT_NEAR(halfDifferenceFromDirections(vec3(0, 0, 1), l, vec3(0, 0, 1)).thetaH, angle, 0.01f * angle);
    }
}

TEST(BrdfCoords, FoldIdentifiesMirrorAndReciprocalPairs)
{
    const vec3 n(0, 0, 1);
    for (const vec3& l : hemisphere()) {
        const vec3 v = polar(0.6f, 0.4f);
        const HalfDifference c = halfDifferenceFromDirections(n, l, v);
        const HalfDifference swapped = halfDifferenceFromDirections(n, v, l);
        const HalfDifference mirrored = halfDifferenceFromDirections(n, vec3(l.x, -l.y, l.z), vec3(v.x, -v.y, v.z));
        // phiD is ill-conditioned where h meets n or l meets v; 1e-3 rad holds for this set elsewhere.
        if (c.thetaH > 1e-2f && c.thetaD > 1e-2f) {
            const float folded = foldedPhiD(c.phiD, kHalfDifference), oneWay = foldedPhiD(c.phiD, kOneWay);
            EXPECT_NEAR(folded, foldedPhiD(swapped.phiD, kHalfDifference), 1e-3f);
            EXPECT_NEAR(folded, foldedPhiD(mirrored.phiD, kHalfDifference), 1e-3f);
            EXPECT_NEAR(oneWay, kPi - foldedPhiD(swapped.phiD, kOneWay), 1e-3f);
            EXPECT_NEAR(oneWay, foldedPhiD(mirrored.phiD, kOneWay), 1e-3f);
        }
    }
}

TEST(BrdfCoords, UnitCubeAndTexelsRoundTrip)
{
    const TableDomain domains[] = {
        {kHalfDifference, 0.4f}, {kHalfDifference, kHalfPi}, {kNatural, kHalfPi}, {kOneWay, 0.4f}, {kOneWay, kHalfPi}};
    const vec3 size(90, 23, 45);
    for (const TableDomain& domain : domains) {
        for (const float a : {0.01f, 0.3f, 0.6f}) {
            for (const float b : {0.05f, 0.5f, 0.95f}) {
                for (const float c : {0.02f, 0.4f, 0.97f}) {
                    const vec3 unit(a, b, c);
                    const LightView d = directionsFromUnit(domain, unit);
                    const vec3 back = unitFromDirections(domain, vec3(0, 0, 1), d.l, d.v);
                    // The azimuth is read off a vector of length sin(thetaH) sin(thetaD), as small as 3e-6 here.
                    EXPECT_NEAR(back.x, unit.x, 1e-5f);
                    EXPECT_NEAR(back.y, unit.y, 1e-5f);
                    EXPECT_NEAR(back.z, unit.z, a > 0.1f ? 1e-4f : 0.05f);
                    const vec3 again = unitFromTexel(texelFromUnit(unit, size), size);
                    EXPECT_NEAR(length(again - unit), 0, 1e-5f);
                }
            }
        }
    }
    EXPECT_FLOAT_EQ(texelFromUnit(vec3(0), size).x, 0.5f / 90);
    EXPECT_FLOAT_EQ(texelFromUnit(vec3(1), size).x, 89.5f / 90);
}

TEST(Ball, NormalRoundTripAndOrientation)
{
    for (const vec3& n : hemisphere()) {
        const vec3 back = normalFromBallTexel(ballTexelFromNormal(n, 128), 128);
        EXPECT_NEAR(length(back - n), 0, 1e-5f);
    }
    EXPECT_LT(ballTexelFromNormal(vec3(0, 1, 0), 64).y, 0.01f) << "row 0 is the top";
}

TEST(Shading, EquationReadsBothWays)
{
    const vec3 f(0.2f, 0.5f, 1.7f), E(1.3f, 0.7f, 2.0f);
    const vec3 radiance = radianceFromBrdf(f, E, 0.35f);
    EXPECT_NEAR(length(brdfFromRadiance(radiance, E, 0.35f) - f), 0, 1e-6f);
    EXPECT_EQ(length(radianceFromBrdf(f, E, -0.2f)), 0);
}

TEST(Shading, SrgbRoundTripAndKnownPoints)
{
    for (int code = 0; code <= 255; ++code) {
        EXPECT_NEAR(srgbFromLinear(linearFromSrgb(code / 255.0f)), code / 255.0f, 2e-6f);
    }
    EXPECT_NEAR(srgbFromLinear(0.214041f), 0.5f, 1e-5f); // IEC 61966-2-1
    EXPECT_FLOAT_EQ(srgbFromLinear(2.0f), 1.0f);
}

} // namespace
} // namespace nacre
