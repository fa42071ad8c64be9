#include "assets/synth/interreflection.h"

#include <cmath>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "assets/synth/bouncing_light.h"
#include "engine/files/hash_random.h"

namespace nacre {
namespace {

using glm::dvec3;

constexpr double kPiDouble = std::numbers::pi;

bool seesAlways(const dvec3&, const dvec3&)
{
    return true;
}

// The inside of a sphere's part about -z, up to `degrees` from there; 180: all of it.
std::vector<SurfaceNode> insideOfCap(double radius, double degrees, int count)
{
    const double height = 1 - std::cos(degrees * kPiDouble / 180);
    std::vector<SurfaceNode> nodes;
    for (int i = 0; i < count; ++i) {
        const double z = -1 + height * (i + 0.5) / count, s = std::sqrt(1 - z * z), phi = 2.39996322972865332 * i;
        const dvec3 direction(s * std::cos(phi), s * std::sin(phi), z);
        nodes.push_back({radius * direction, -direction, 2 * kPiDouble * radius * radius * height / count});
    }
    return nodes;
}

std::vector<FormFactors> factorsBetween(const std::vector<SurfaceNode>& nodes, const Sees& sees)
{
    std::vector<FormFactors> factors;
    for (const SurfaceNode& node : nodes) {
        factors.push_back(formFactorsAt(node.place, node.normal, nodes, sees));
    }
    return factors;
}

double sumOf(const FormFactors& factors)
{
    double sum = 0;
    for (const FormFactor& factor : factors) {
        sum += factor.share;
    }
    return sum;
}

// Within a sphere of radius R every two points have K = 1 / (4 pi R^2), so that every point of a part of area A sees
// F = A / (4 pi R^2) of it, and light that is sent evenly grows to 1 + aF + (aF)^2 + ..., each bounce a term.
TEST(Interreflection, FollowsTheSeriesOfASphericalCap)
{
    constexpr int kCount = 400;
    for (const double degrees : {60.0, 90.0, 180.0}) {
        const std::vector<SurfaceNode> nodes = insideOfCap(0.7, degrees, kCount);
        const std::vector<FormFactors> factors = factorsBetween(nodes, seesAlways);
        // A node does not see itself: its own piece is missing.
        const double share = (1 - std::cos(degrees * kPiDouble / 180)) / 2 * (kCount - 1) / kCount;
        for (const FormFactors& row : factors) {
            ASSERT_NEAR(sumOf(row), share, 1e-5);
        }
        const dvec3 albedo(0.9, 0.5, 0), lit(2);
        const std::vector<dvec3> albedos(kCount, albedo), everywhere(kCount, lit);
        for (const int bounces : {1, 2, 8, 64}) {
            dvec3 series(0);
            for (int k = 0; k < bounces; ++k) {
                series = 1.0 + albedo * share * series;
            }
            for (const dvec3& sent : sentAfter(bounces, factors, albedos, everywhere)) {
                for (int c = 0; c < 3; ++c) {
                    ASSERT_NEAR(sent[c], albedo[c] * lit[c] * series[c], 1e-4) << bounces << " " << degrees;
                }
            }
        }
    }
}

// In a closed white room nothing is lost: each bounce adds what the first one sent.
TEST(Interreflection, AWhiteRoomLosesNothing)
{
    constexpr int kCount = 300;
    const std::vector<SurfaceNode> nodes = insideOfCap(1, 180, kCount);
    const std::vector<FormFactors> factors = factorsBetween(nodes, seesAlways);
    std::vector<dvec3> lit(kCount, dvec3(0));
    lit[7] = dvec3(1);
    const std::vector<dvec3> albedos(kCount, dvec3(1));
    for (const int bounces : {1, 2, 5}) {
        double power = 0;
        for (const dvec3& sent : sentAfter(bounces, factors, albedos, lit)) {
            power += sent.x;
        }
        EXPECT_NEAR(power, bounces, bounces * 0.01); // a node is 1/300 of the room, and does not see itself
    }
}

dvec3 nodeLight(const SurfaceNode& node)
{
    return dvec3(std::max(0.0, glm::dot(node.normal, glm::normalize(dvec3(0.5, 0.2, 0.8)))));
}

TEST(Interreflection, OfTheBowlIsReciprocalAndGainsNoEnergy)
{
    const BumpySolid bowl = bowlSolid();
    const std::vector<SurfaceNode> nodes = nodesOf(bowl, 1000);
    const std::vector<FormFactors> factors =
        factorsBetween(nodes, [&](const dvec3& a, const dvec3& b) { return bowl.sees(a, b); });
    size_t pairs = 0;
    for (size_t i = 0; i < nodes.size(); ++i) {
        EXPECT_LE(sumOf(factors[i]), 1);
        for (const FormFactor& factor : factors[i]) {
            for (const FormFactor& back : factors[factor.node]) {
                if (back.node == i) {
                    ++pairs;
                    const double there = nodes[i].area * factor.share;
                    EXPECT_NEAR(nodes[factor.node].area * back.share, there, 1e-5 * there);
                }
            }
        }
    }
    EXPECT_GT(pairs, 5000u);
    std::vector<dvec3> lit;
    for (const SurfaceNode& node : nodes) {
        lit.push_back(nodeLight(node));
    }
    const auto powerAfter = [&](int bounces) {
        const std::vector<dvec3> sent = sentAfter(bounces, factors, std::vector<dvec3>(nodes.size(), dvec3(1)), lit);
        double power = 0;
        for (size_t i = 0; i < nodes.size(); ++i) {
            power += nodes[i].area * sent[i].x;
        }
        return power;
    };
    double before = 0, gain = powerAfter(1);
    for (int bounces = 1; bounces < 6; ++bounces) {
        const double power = powerAfter(bounces), added = power - before;
        EXPECT_GT(added, 0);
        EXPECT_LE(added, gain * (1 + 1e-9)) << "a bounce sends more than it was sent";
        before = power;
        gain = added;
    }
}

// Where a ray that leaves a surface point meets the surface again, in short steps; empty where it does not.
std::optional<dvec3> slowHit(const BumpySolid& solid, const dvec3& from, const dvec3& direction)
{
    constexpr double kStep = 5e-4;
    for (double t = kStep; t < 2.5; t += kStep) {
        if (solid.outside(from + t * direction) < 0) {
            return from + (t - kStep / 2) * direction;
        }
    }
    return std::nullopt;
}

// Directions as a matt surface sends them, on a grid of equal shares.
dvec3 mattDirection(const dvec3& normal, int i, int count)
{
    const double r2 = (i + 0.5) / count, r = std::sqrt(r2), phi = 2.39996322972865332 * i;
    const dvec3 u = glm::normalize(glm::cross(normal, std::abs(normal.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
    return r * std::cos(phi) * u + r * std::sin(phi) * glm::cross(normal, u) + std::sqrt(1 - r2) * normal;
}

// The same integral by rays from the receiving point, which know of no nodes: what arrives of light that every point
// sends as nodeLight says.
TEST(Interreflection, OfTheBowlIsWhatRaysBring)
{
    const BumpySolid bowl = bowlSolid();
    const Sees sees = [&](const dvec3& a, const dvec3& b) { return bowl.sees(a, b); };
    const std::vector<SurfaceNode> nodes = nodesOf(bowl, 5000);
    std::vector<dvec3> sent;
    for (const SurfaceNode& node : nodes) {
        sent.push_back(nodeLight(node));
    }
    constexpr int kRays = 4000;
    for (const dvec3& towards :
         {dvec3(0.1, 0.15, 0.98), dvec3(0.35, 0.1, 0.93), dvec3(-0.25, -0.2, 0.94), dvec3(0.1, 0.6, 0.79)}) {
        const dvec3 place = bowl.pointTowards(glm::normalize(towards)), normal = bowl.normal(place);
        double brought = 0;
        for (int i = 0; i < kRays; ++i) {
            if (const auto hit = slowHit(bowl, place, mattDirection(normal, i, kRays))) {
                brought += nodeLight({*hit, bowl.normal(*hit), 0}).x / kRays;
            }
        }
        const double sum = arriving(formFactorsAt(place, normal, nodes, sees), sent).x;
        EXPECT_GT(brought, 0.01);
        EXPECT_NEAR(sum, brought, 0.01 * brought) << towards.x;
    }
}

TEST(Interreflection, ReflectsTheMaterialsAlbedo)
{
    LambertGgx matt;
    matt.diffuse = {0.9f, 0.5f, 0.0f};
    matt.specular = {0, 0, 0};
    const dvec3 albedo = meanAlbedo(matt);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(albedo[c], matt.diffuse[c], 0.002);
    }
    LambertGgx glossy = matt;
    glossy.specular = {0.04f, 0.04f, 0.04f};
    EXPECT_GT(meanAlbedo(glossy).z, 0.03);
    EXPECT_LT(meanAlbedo(glossy).z, 0.2);
}

TEST(Interreflection, AConvexSolidHasNone)
{
    const BumpySolid sphere = plainSphere();
    const std::vector<SurfaceNode> nodes = nodesOf(sphere, 500);
    double area = 0;
    for (const SurfaceNode& node : nodes) {
        area += node.area;
        EXPECT_TRUE(formFactorsAt(node.place, node.normal, nodes, seesAlways).empty());
    }
    EXPECT_NEAR(area, 4 * kPiDouble * 0.92 * 0.92, 1e-9);
}

} // namespace
} // namespace nacre
