#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/brdf/bake.h"
#include "acquisition/brdf/completion.h"
#include "acquisition/brdf/local_linear.h"
#include "engine/brdf/brdf_audit.h"
#include "engine/brdf/brdf_tabulation.h"
#include "engine/files/hash_random.h"
#include "engine/files/measures.h"

namespace nacre {
namespace {

using SampledTruth = std::function<glm::vec3(const LightView& d)>;

const TableDomain kFront{kHalfDifference, kHalfPi / 2};
constexpr float kMeasuredShare = 0.5f; // of the domain's thetaD: lights to 45 degrees

// Samples on 20 planes of thetaD up to kMeasuredShare, with relative noise.
BrdfSamples measuredSamples(const SampledTruth& truth, float noise = 0)
{
    BrdfSamples samples;
    samples.domain = kFront;
    for (size_t i = 0; i < 12000; ++i) {
        const auto random = [&](uint64_t which) { return static_cast<float>(unitFromHash(hashOf(i, which))); };
        const float plane = (static_cast<float>(i % 20) + 0.5f) / 20;
        const glm::vec3 unit(random(0), kMeasuredShare * plane, random(1));
        const LightView d = directionsFromUnit(kFront, unit);
        if (std::min(d.l.z, d.v.z) > 0.1f) {
            samples.unit.push_back(unit);
            samples.values.push_back(truth(d) * (1 + noise * (2 * random(2) - 1)));
            samples.weights.push_back(d.l.z);
        }
    }
    return samples;
}

SampledTruth truthOf(const BrdfModel& model)
{
    return [model](const LightView& d) { return evaluate(model, {0, 0, 1}, d.l, d.v); };
}

// Every twentieth ABC fit, and a prior of the SGD fits of other materials: the lists have nearly the same order.
struct LeftOut {
    BrdfModel model;
    MaterialPrior prior;
};

std::vector<LeftOut> leftOutFits()
{
    const std::vector<BrdfModel> fits = publishedFits();
    const size_t half = fits.size() / 2;
    std::vector<LeftOut> all;
    for (size_t i = 7; i < half; i += 20) {
        std::vector<BrdfModel> others;
        for (size_t j = half; j < fits.size(); ++j) {
            if (j + 2 < half + i || j > half + i + 2) {
                others.push_back(fits[j]);
            }
        }
        all.push_back({fits[i], makeMaterialPrior(others, 0)});
    }
    return all;
}

// The table's texels beyond what was measured, to lights at 70 degrees.
template <class Visit> void forEachUnseen(const BrdfTable& table, Visit&& visit)
{
    for (int k = 0; k < table.size.z; k += 4) {
        for (int j = table.size.y * 55 / 100; j < table.size.y * 77 / 100; j += 3) {
            for (int i = 0; i < table.size.x; i += 4) {
                const LightView d = table.directions(i, j, k);
                if (std::min(d.l.z, d.v.z) > 0.1f) {
                    visit(table.index(i, j, k), glm::vec3(i, j, k) / (glm::vec3(table.size) - 1.0f), d);
                }
            }
        }
    }
}

float relativeError(const glm::vec3& f, const glm::vec3& truth)
{
    return std::abs(greyOf(f) / greyOf(truth) - 1);
}

TEST(Completion, PredictsWhatWasNotMeasuredBetterThanTheNearestSamples)
{
    double ours = 0, nearest = 0, within = 0, told = 0;
    for (const LeftOut& subject : leftOutFits()) {
        const BrdfSamples samples = measuredSamples(truthOf(subject.model));
        const CompletedBrdf whole(samples, {}, subject.prior);
        const LocalLinearRegression local(samples, {}, InterpolationOptions{}.k);
        forEachUnseen(BrdfTable({90, 46, 23}, kFront), [&](size_t, const glm::vec3& unit, const LightView& d) {
            const glm::vec3 truth = truthOf(subject.model)(d);
            const InterpolatedValue value = whole.evaluate(unit);
            const float error = relativeError(value.value, truth);
            ours += error;
            nearest += relativeError(local.evaluate({unit.x, kMeasuredShare, unit.z}).value, truth);
            if (value.error <= 0.1f) {
                told += 1;
                within += error <= 0.1f;
            }
        });
    }
    RecordProperty("errorOverNearest", std::to_string(ours / nearest));
    RecordProperty("withinTenPercent", std::to_string(within / told));
    EXPECT_LT(ours, 0.5 * nearest);
    EXPECT_GT(told, 100);
    EXPECT_GE(within, 0.9 * told);
}

TEST(Completion, WhatWasMeasuredStands)
{
    // The second throws light back to where it came from, as no material of the prior does.
    const SampledTruth truths[] = {truthOf(LambertGgx{}), [](const LightView& d) {
                                       const float apart = glm::length(d.l - d.v);
                                       return glm::vec3(0.1f + 2 * std::exp(-20 * apart * apart));
                                   }};
    for (const SampledTruth& truth : truths) {
        const BrdfSamples samples = measuredSamples(truth);
        const CompletedBrdf whole(samples, {}, publishedMaterialPrior());
        const LocalLinearRegression local(samples, {}, InterpolationOptions{}.k);
        double ours = 0, interpolated = 0, count = 0;
        for (size_t i = 0; i < samples.size(); i += 17) {
            ours += relativeError(whole.evaluate(samples.unit[i]).value, samples.values[i]);
            interpolated += relativeError(local.evaluate(samples.unit[i]).value, samples.values[i]);
            count += 1;
        }
        EXPECT_LT(ours / count, 1.1 * interpolated / count + 0.001);
    }
}

TEST(Completion, IsReciprocalAndGainsNoEnergy)
{
    for (const LeftOut& subject : leftOutFits()) {
        const auto truth = std::make_shared<BrdfTable>(tabulatedBrdf(subject.model, {90, 46, 23}, kFront));
        const auto own = auditBrdf(functionOf(std::shared_ptr<const BrdfTable>(truth)), 0, 2000);
        const BrdfSamples samples = measuredSamples(truthOf(subject.model));
        const CompletedBrdf whole(samples, {}, subject.prior);
        const auto table = std::make_shared<const BrdfTable>(
            bakeBrdf(samples, BrdfInterpolant([&](const glm::vec3& unit) { return whole.evaluate(unit); }), {}).table);
        const BrdfAudit audit = auditBrdf(functionOf(table), 0, 2000);
        EXPECT_LT(audit.reciprocityMost, 1e-3);
        EXPECT_EQ(audit.negative, 0u);
        EXPECT_LE(audit.largestAlbedo, std::max(1.0, own.largestAlbedo) + 0.02);
    }
}

TEST(Completion, FewAndNoisySamplesStayBounded)
{
    BrdfSamples noisy = measuredSamples(truthOf(LambertGgx{}), 0.05f), two = noisy, slice = noisy, mirror = noisy;
    two.unit.resize(2), two.values.resize(2), two.weights.resize(2);
    for (size_t i = 0; i < noisy.size(); ++i) {
        slice.unit[i].y = 0.3f;
        mirror.unit[i].x = 0;
    }
    for (const BrdfSamples& samples : {noisy, two, slice, mirror}) {
        float most = 0;
        for (const glm::vec3& value : samples.values) {
            most = std::max(most, value.x);
        }
        const CompletedBrdf whole(samples, {}, publishedMaterialPrior());
        for (size_t i = 0; i < 2000; ++i) {
            const glm::vec3 unit(unitFromHash(hashOf(i, 5)), unitFromHash(hashOf(i, 6)), unitFromHash(hashOf(i, 7)));
            const InterpolatedValue value = whole.evaluate(unit);
            ASSERT_TRUE(std::isfinite(value.value.x + value.value.y + value.value.z + value.error));
            ASSERT_GE(std::min({value.value.x, value.value.y, value.value.z}), 0);
            ASSERT_LT(value.value.x, 100 * most);
            ASSERT_GT(value.error, 0);
        }
    }
}

TEST(Completion, BlackStaysBlack)
{
    BrdfSamples samples = measuredSamples([](const LightView&) { return glm::vec3(0); });
    const CompletedBrdf whole(samples, {}, publishedMaterialPrior());
    EXPECT_EQ(whole.evaluate({0.4f, 0.3f, 0.5f}).value, glm::vec3(0));
    EXPECT_LT(whole.evaluate({0.4f, 0.9f, 0.5f}).value.x, 1e-6f);
}

TEST(Completion, HasNoSeamAtTheLargestMeasuredThetaD)
{
    const BrdfSamples samples = measuredSamples(truthOf(LambertGgx{}));
    const CompletedBrdf whole(samples, {}, publishedMaterialPrior());
    const float border = kMeasuredShare * 19.5f / 20;
    for (const float x : {0.1f, 0.4f, 0.7f}) {
        const float before = whole.evaluate({x, border - 1e-4f, 0.5f}).value.x,
                    after = whole.evaluate({x, border + 1e-4f, 0.5f}).value.x;
        EXPECT_NEAR(after / before, 1, 0.01f) << x;
    }
}

} // namespace
} // namespace nacre
