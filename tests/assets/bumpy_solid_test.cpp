#include "assets/synth/bumpy_solid.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace nacre {
namespace {

using glm::dvec3;

const SolidView& bumpyView()
{
    static const SolidView view = viewOf(bumpySolid(), 96, 96, 0);
    return view;
}

dvec3 lightAt(double polarDegrees, double azimuthDegrees)
{
    double theta = polarDegrees * M_PI / 180.0;
    double phi = azimuthDegrees * M_PI / 180.0;
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// Walks the ray in steps too short to miss anything that matters, knowing nothing of bounds on the slope.
bool reachesLightSlowly(const BumpySolid& solid, const dvec3& p, const dvec3& light)
{
    for (double t = 1e-3; t < 3.0; t += 1e-3) {
        if (solid.outside(p + t * light) < 0.0) {
            return false;
        }
    }
    return true;
}

TEST(BumpySolid, SeenPointsLieOnTheSurface)
{
    BumpySolid solid = bumpySolid();
    for (uint32_t pixel : bumpyView().seen) {
        // Bisection halves a step of at most 2 forty-eight times.
        EXPECT_NEAR(solid.outside(bumpyView().surfacePoint(pixel)), 0.0, 1e-12);
    }
}

TEST(BumpySolid, NothingLiesBeforeTheSeenPoint)
{
    BumpySolid solid = bumpySolid();
    for (uint32_t pixel : bumpyView().seen) {
        for (dvec3 p = bumpyView().surfacePoint(pixel) + dvec3(0, 0, 1e-3); p.z < 1.2; p.z += 5e-3) {
            ASSERT_GT(solid.outside(p), 0.0) << "pixel " << pixel;
        }
    }
}

TEST(BumpySolid, NormalsAreUnitAndMatchTheDepthsSlope)
{
    BumpySolid solid = bumpySolid();
    constexpr double kStep = 1e-4;
    size_t compared = 0;
    for (uint32_t pixel : bumpyView().seen) {
        const glm::vec3& n = bumpyView().normals.normals[pixel];
        EXPECT_NEAR(glm::length(n), 1.0f, 1e-6f);
        EXPECT_GT(n.z, 0.0f) << "faces the camera that sees it";
        if (n.z < 0.4f) {
            continue; // near an edge the differences reach past it
        }
        glm::dvec2 p = bumpyView().planePoint(pixel);
        auto z = [&](double dx, double dy) { return solid.depthTowardsCamera(p.x + dx, p.y + dy).value(); };
        dvec3 fromDepth = glm::normalize(dvec3(z(-kStep, 0) - z(kStep, 0), z(0, -kStep) - z(0, kStep), 2.0 * kStep));
        // The differences' own error is the depth's third derivative, up to some hundreds, times kStep^2 / 6.
        EXPECT_LT(glm::length(fromDepth - dvec3(n)), 1e-5) << "pixel " << pixel;
        ++compared;
    }
    EXPECT_GT(compared, 2000u);
}

TEST(BumpySolid, FillsThePictureWithoutTouchingItsBorder)
{
    for (const SolidView& view : {bumpyView(), viewOf(bowlSolid(), 96, 96, 0)}) {
        const std::vector<uint8_t>& mask = view.mask;
        EXPECT_GT(view.seen.size(), mask.size() / 3);
        for (int i = 0; i < 96; ++i) {
            EXPECT_FALSE(mask[i] || mask[95 * 96 + i] || mask[i * 96] || mask[i * 96 + 95]);
        }
    }
}

TEST(BumpySolid, CastsShadowsUnderObliqueLights)
{
    BumpySolid solid = bumpySolid();
    for (double azimuth : {20.0, 140.0, 260.0}) {
        dvec3 light = lightAt(45, azimuth);
        size_t facing = 0, shadowed = 0;
        for (uint32_t pixel : bumpyView().seen) {
            dvec3 p = bumpyView().surfacePoint(pixel);
            if (glm::dot(solid.normal(p), light) < 0.02) {
                continue; // where the light only grazes, the slow walk's first step already decides
            }
            ++facing;
            bool lit = solid.reachesLight(p, light);
            shadowed += !lit;
            ASSERT_EQ(lit, reachesLightSlowly(solid, p, light)) << "pixel " << pixel;
        }
        EXPECT_GT(shadowed, facing / 100);
        EXPECT_LT(shadowed, facing / 2);
    }
}

TEST(BumpySolid, ASphereCastsNone)
{
    BumpySolid sphere = plainSphere();
    SolidView view = viewOf(sphere, 64, 64, 0);
    for (const dvec3& light : {lightAt(0, 0), lightAt(45, 30), lightAt(80, 200)}) {
        for (uint32_t pixel : view.seen) {
            dvec3 p = view.surfacePoint(pixel);
            EXPECT_EQ(sphere.reachesLight(p, light), glm::dot(sphere.normal(p), light) > 0.0);
        }
    }
}

TEST(SolidView, PutsYUpAndKeepsTheAspect)
{
    SolidView view = viewOf(plainSphere(), 60, 40, 1);
    EXPECT_GT(view.normals.normals[view.normals.index(30, 4)].y, 0.5f) << "row 0 is the top";
    EXPECT_GT(view.normals.normals[view.normals.index(46, 20)].x, 0.5f);
    EXPECT_FALSE(view.mask[view.normals.index(5, 20)]);
    EXPECT_EQ(view.planePoint(20 * 60 + 30), glm::dvec2(0.025, -0.025));
}

} // namespace
} // namespace nacre
