#include "engine/brdf/brdf_audit.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "engine/brdf/brdf_tabulation.h"
#include "tests/support/models_as_tables.h"

namespace nacre {
namespace {

const LambertGgx kLambert{vec3(0.6f, 0.5f, 0.4f), vec3(0), 0.3f};
const LambertGgx kGlossy{vec3(0.3f, 0.2f, 0.1f), vec3(0.05f), 0.15f};

TEST(BrdfAudit, LambertReflectsItsAlbedo)
{
    const BrdfAudit audit = auditBrdf(functionOf(kLambert), 0, 2000);
    for (const DirectionalAlbedo& a : audit.albedos) {
        EXPECT_NEAR(a.albedo.x, 0.6, 2e-3) << a.thetaDegrees; // 360 x 180 half vectors
        EXPECT_NEAR(a.albedo.z, 0.4, 2e-3);
        EXPECT_EQ(a.covered, 1);
    }
    EXPECT_NEAR(audit.largestAlbedo, 0.6, 2e-3);
    EXPECT_EQ(audit.negative, 0u);
    EXPECT_EQ(audit.notFinite, 0u);
    EXPECT_LT(audit.reciprocityMost, 1e-6);
}

// The same integral over directions of light, by the midpoint rule.
TEST(BrdfAudit, AgreesWithTheIntegralOverLight)
{
    const BrdfFunction f = functionOf(kGlossy);
    const double theta = glm::radians(60.0);
    const vec3 v = tangentDirection(theta, 0);
    double sum = 0;
    constexpr int kSteps = 600;
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
            const double t = (i + 0.5) * M_PI / 2 / kSteps, phi = (j + 0.5) * 2 * M_PI / kSteps;
            sum += f(tangentDirection(t, phi), v).value.x * std::cos(t) * std::sin(t) * M_PI * M_PI / kSteps / kSteps;
        }
    }
    EXPECT_NEAR(directionalAlbedo(f, 60).albedo.x, sum, 2e-3 * sum);
}

TEST(BrdfAudit, FindsWhatIsWrong)
{
    const BrdfFunction oneWay = [](const vec3& l, const vec3& v) {
        return BrdfValue{vec3(l.z > v.z ? 1.1f : 0.9f), 1.0f};
    };
    EXPECT_NEAR(auditBrdf(oneWay, 0, 2000).reciprocity95, 0.2, 1e-5);
    EXPECT_GT(auditBrdf([](auto&&, auto&&) { return BrdfValue{vec3(0.4f), 1}; }).largestAlbedo, 1.2); // 0.4 pi
    const BrdfFunction negative = [](const vec3& l, const vec3& v) {
        return BrdfValue{vec3(1, l.z + v.z > 1 ? 1.0f : -1.0f, 1), 1.0f};
    };
    EXPECT_GT(auditBrdf(negative, 0, 2000).negative, 100u);
    const BrdfFunction undefined = [](const vec3& l, const vec3&) {
        return BrdfValue{vec3(l.z > 0.5f ? 1.0f : std::numeric_limits<float>::quiet_NaN()), 1.0f};
    };
    const BrdfAudit audit = auditBrdf(undefined, 0, 2000);
    EXPECT_GT(audit.notFinite, 100u);
    EXPECT_TRUE(std::isfinite(audit.largestAlbedo) && std::isfinite(audit.reciprocity95));
    const BrdfFunction uncovered = [](auto&&, auto&&) { return BrdfValue{vec3(1), 0}; };
    EXPECT_EQ(auditBrdf(uncovered, 0, 2000).configurations, 0u);
}

TEST(BrdfAudit, IsTheSameForAnyNumberOfThreads)
{
    const BrdfAudit a = auditBrdf(functionOf(kGlossy), 1, 500), b = auditBrdf(functionOf(kGlossy), 3, 500);
    for (size_t i = 0; i < a.albedos.size(); ++i) {
        EXPECT_EQ(a.albedos[i].albedo, b.albedos[i].albedo);
    }
}

TEST(BrdfComparison, StatesAKnownError)
{
    const BrdfFunction f = functionOf(kLambert);
    const BrdfFunction brighter = [&](const vec3& l, const vec3& v) {
        BrdfValue value = f(l, v);
        value.value *= 1.1f;
        return value;
    };
    const BrdfComparison c = compareBrdfs(brighter, f, 3000);
    EXPECT_NEAR(c.median, 0.1, 1e-5);
    EXPECT_NEAR(c.percentile95, 0.1, 1e-5);
    EXPECT_NEAR(c.peak, 0.6 / M_PI, 1e-6);
    // Scaled by red's value: red is clipped, green and blue are off by a tenth of 5/6 and 4/6.
    EXPECT_NEAR(c.psnr, -10 * std::log10((std::pow(0.5 / 6, 2) + std::pow(0.4 / 6, 2)) / 3), 1e-3);
    EXPECT_TRUE(std::isinf(compareBrdfs(f, f, 3000).psnr));
}

TEST(BrdfComparison, LeavesOutWhatIsNotCovered)
{
    const BrdfModel part = modelOf(tabulatedBrdf(kLambert, {30, 20, 20}, {kHalfDifference, kHalfPi / 2}));
    const BrdfComparison c = compareBrdfs(functionOf(part), functionOf(kLambert), 5000);
    EXPECT_LT(c.configurations, c.outOf * 0.75);
    EXPECT_GT(c.configurations, c.outOf * 0.45);
    EXPECT_LT(c.percentile95, 1e-5);
}

TEST(BrdfComparison, ConfigurationsCoverTheHemisphere)
{
    const std::vector<LightView> all = comparisonConfigurations(5000);
    EXPECT_GT(all.size(), 3000u);
    float least = 1, most = 0;
    for (const LightView& d : all) {
        EXPECT_GE(std::min(d.l.z, d.v.z), 0.05f);
        least = std::min(least, d.l.z);
        most = std::max(most, d.l.z);
    }
    EXPECT_LT(least, 0.06f);
    EXPECT_GT(most, 0.999f);
}

TEST(BrdfTabulation, FillsFromTheNearestCovered)
{
    BrdfTable table({5, 1, 1}, {kHalfDifference, kHalfPi});
    table.values[1] = vec3(2);
    table.values[4] = vec3(4);
    table.confidence[1] = table.confidence[4] = 1;
    fillUncovered(table);
    EXPECT_EQ(table.values[0], vec3(2));
    EXPECT_EQ(table.values[2], vec3(2));
    EXPECT_EQ(table.values[3], vec3(4));
    EXPECT_EQ(table.confidence[3], 0);
}

TEST(BrdfTabulation, DoesNotDarkenTheHorizon)
{
    const BrdfModel table = modelOf(tabulatedBrdf(kLambert));
    // Texels below the horizon take part in interpolation near it.
    for (const double theta : {0.8, 1.4, 1.5, 1.56}) {
        for (double phi = 0; phi < 3.1; phi += 0.1) {
            const vec3 f = evaluate(table, {0, 0, 1}, tangentDirection(theta, 0), tangentDirection(1.56, phi));
            EXPECT_NEAR(f.x, 0.6 / M_PI, 1e-5) << theta << " " << phi;
        }
    }
}

} // namespace
} // namespace nacre
