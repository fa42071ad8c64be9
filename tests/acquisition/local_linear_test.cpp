#include <cmath>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "acquisition/brdf/bake.h"
#include "acquisition/brdf/interpolation_choice.h"
#include "acquisition/brdf/local_linear.h"
#include "acquisition/brdf/sample_cells.h"
#include "engine/brdf/brdf_models.h"
#include "engine/files/error.h"
#include "engine/files/hash_random.h"

namespace nacre {
namespace {

using Truth = std::function<glm::vec3(const glm::vec3& unit)>;

// Samples on `planes` planes of constant thetaD, as photographs give them.
BrdfSamples planeSamples(size_t planes, size_t perPlane, const Truth& truth)
{
    BrdfSamples samples;
    samples.domain = {kHalfDifference, 0.4f};
    for (size_t p = 0; p < planes; ++p) {
        for (size_t i = 0; i < perPlane; ++i) {
            const auto random = [&](uint64_t which) {
                return static_cast<float>(unitFromHash(hashOf(hashOf(p, i), which)));
            };
            const glm::vec3 unit(random(0), (p + 0.5f) / planes, random(1));
            samples.unit.push_back(unit);
            samples.values.push_back(truth(unit));
            samples.weights.push_back(0.5f + 0.5f * random(2));
        }
    }
    return samples;
}

glm::vec3 constantTruth(const glm::vec3&)
{
    return {0.3f, 0.2f, 0.1f};
}

Truth ggxTruth(float alpha)
{
    const BrdfModel model = LambertGgx{glm::vec3(0.3f), glm::vec3(0.05f), alpha};
    return [model](const glm::vec3& unit) {
        const LightView d = directionsFromUnit({kHalfDifference, 0.4f}, unit);
        return evaluate(model, {0, 0, 1}, d.l, d.v);
    };
}

bool isFinite(const glm::vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

const glm::vec3 kQueries[] = {{0, 0, 0},          {1, 1, 1},    {0.5f, 0.5f, 0.5f},
                              {0, 1, 0.3f},       {1, 0, 0.7f}, {0.31f, 0.77f, 0.11f},
                              {2.0f, -1.0f, 3.0f}}; // the last beyond the range

TEST(LocalLinear, ConstantDataInterpolateToTheConstant)
{
    const BrdfInterpolant f = makeInterpolant(planeSamples(9, 200, constantTruth), {});
    for (const glm::vec3& unit : kQueries) {
        // Cube roots and their cubes in float.
        EXPECT_LT(glm::length(f(unit).value - constantTruth(unit)), 2e-6f);
    }
}

TEST(LocalLinear, FollowsASlopeWhereAMeanFlattensIt)
{
    // Linear in the embedded space's thetaH axis, in cube roots: exact up to the ridge on the slopes.
    const auto slope = [](const glm::vec3& unit) { return glm::vec3(std::pow(0.5f + unit.x, 3.0f)); };
    const BrdfSamples samples = planeSamples(9, 400, slope);
    const BrdfInterpolant local = makeInterpolant(samples, {}),
                          paper = makeInterpolant(samples, {.method = InterpolationMethod::paper});
    double localError = 0, paperError = 0;
    for (int i = 0; i < 50; ++i) {
        const glm::vec3 unit(i / 49.0f, 0.45f, 0.5f); // the border of thetaH included
        localError += std::abs(local(unit).value.x - slope(unit).x);
        paperError += std::abs(paper(unit).value.x - slope(unit).x);
    }
    EXPECT_LT(localError / 50, 5e-3); // of values from 0.125 to 3.4
    EXPECT_LT(localError, 0.2 * paperError);
}

TEST(LocalLinear, KeepsAHighlightThatTheMeanDarkens)
{
    const Truth truth = ggxTruth(0.05f);
    const BrdfSamples samples = planeSamples(18, 400, truth);
    const glm::vec3 top(0, 0.5f, 0);
    const float expected = truth(top).x;
    const float local = makeInterpolant(samples, {})(top).value.x;
    EXPECT_NEAR(local / expected, 1, 0.05); // asked of a lobe that the samples resolve
    EXPECT_LT(makeInterpolant(samples, {.method = InterpolationMethod::paper})(top).value.x, 0.98f * expected);
}

TEST(LocalLinear, DegenerateSamplesAreDefined)
{
    const glm::vec3 expected = constantTruth({});
    for (const size_t planes : {size_t{1}, size_t{3}}) { // one plane leaves the slope along thetaD unknown
        for (const size_t count : {size_t{1}, size_t{2}, size_t{30}}) {
            const BrdfSamples samples = planeSamples(planes, count, constantTruth);
            for (const int k : {1, 25, 500}) { // also more than there are samples
                for (const auto method : {InterpolationMethod::localLinear, InterpolationMethod::paper}) {
                    const BrdfInterpolant f = makeInterpolant(samples, {.method = method, .k = k});
                    for (const glm::vec3& unit : kQueries) {
                        EXPECT_LT(glm::length(f(unit).value - expected), 2e-6f) << planes << " " << count << " " << k;
                    }
                }
            }
        }
    }
    BrdfSamples equal = planeSamples(1, 60, constantTruth); // k equal points
    equal.unit.assign(equal.unit.size(), glm::vec3(0.5f));
    EXPECT_LT(glm::length(makeInterpolant(equal, {})({0.5f, 0.5f, 0.5f}).value - expected), 2e-6f);
    EXPECT_LT(glm::length(makeInterpolant(equal, {})({0, 0, 0}).value - expected), 2e-6f);
}

TEST(LocalLinear, UnusableSamplesAreLeftOut)
{
    BrdfSamples samples = planeSamples(9, 200, constantTruth);
    samples.values[3].y = std::nanf("");
    samples.values[4].x = INFINITY;
    samples.unit[5].z = std::nanf("");
    samples.weights[6] = std::nanf("");
    samples.weights[7] = 0;
    samples.values[7] = glm::vec3(1000);
    for (const auto method : {InterpolationMethod::localLinear, InterpolationMethod::paper}) {
        const BrdfInterpolant f = makeInterpolant(samples, {.method = method});
        EXPECT_LT(glm::length(f(samples.unit[7]).value - constantTruth({})), 2e-6f);
    }
    samples.weights.assign(samples.weights.size(), 0.0f);
    EXPECT_THROW(makeInterpolant(samples, {}), Error);
    EXPECT_THROW(makeInterpolant(planeSamples(2, 5, constantTruth), {.k = 0}), Error);
    EXPECT_THROW(makeInterpolant(planeSamples(2, 5, constantTruth), {.k = kMostNeighbours + 1}), Error);
}

TEST(LocalLinear, StaysNearWhatTheNeighboursShowAndAboveZero)
{
    const auto steep = [](const glm::vec3& unit) { return glm::vec3(std::exp(-400 * unit.x * unit.x)); };
    const BrdfInterpolant f = makeInterpolant(planeSamples(5, 300, steep), {.k = 12});
    for (int i = 0; i <= 200; ++i) {
        for (const float y : {0.0f, 0.5f, 1.0f}) {
            const glm::vec3 value = f({i / 200.0f, y, 0.3f}).value;
            EXPECT_TRUE(isFinite(value));
            EXPECT_GE(value.x, 0);
            EXPECT_LE(value.x, 1.25f * 1.25f * 1.25f); // a quarter of the range beyond 1, in cube roots
        }
    }
}

TEST(SampleCells, AverageNoiseAwayAndForgetOutliers)
{
    BrdfSamples samples = planeSamples(1, 1000, constantTruth);
    samples.unit.assign(samples.unit.size(), glm::vec3(0.5f));
    for (size_t i = 0; i < samples.size(); ++i) {
        samples.values[i] *= static_cast<float>(0.9 + 0.2 * unitFromHash(hashOf(9, i)));
        if (i % 10 == 0) {
            samples.values[i] *= 20.0f; // an interreflection
        }
    }
    const BrdfSamples cells = condensedSamples(samples, 1);
    ASSERT_EQ(cells.size(), 1u);
    // A mean would be off by a factor of 2.9; Huber's bounds each outlier's pull to 1.3 deviations of 0.06.
    EXPECT_NEAR(cells.values[0].x / 0.3f, 1, 0.02);
    EXPECT_GT(cells.weights[0], 10 * samples.weights[0]);
}

TEST(InterpolationChoice, TakesFewNeighboursForSharpDataAndManyForNoise)
{
    const BrdfSamples sharp = planeSamples(24, 800, ggxTruth(0.05f));
    BrdfSamples noisy = planeSamples(24, 100, constantTruth);
    for (size_t i = 0; i < noisy.size(); ++i) {
        noisy.values[i] *= static_cast<float>(0.5 + unitFromHash(hashOf(3, i)));
    }
    const InterpolationChoice few = chooseInterpolation(sharp, {}), many = chooseInterpolation(noisy, {});
    EXPECT_LE(few.options.k, 25);
    EXPECT_GE(many.options.k, 50);
    EXPECT_LE(few.error, few.firstError);
    EXPECT_LT(many.error, many.firstError);
    EXPECT_EQ(chooseInterpolation(planeSamples(1, 1, constantTruth), {}).heldOut, 0u); // nothing to judge by
}

TEST(Bake, ASingleLightGivesATableWithoutNan)
{
    const BakedBrdf baked = bakeBrdf(planeSamples(1, 50, ggxTruth(0.2f)), InterpolationOptions{}, {.size = {12, 5, 6}});
    for (const glm::vec3& value : baked.table.values) {
        EXPECT_TRUE(isFinite(value));
    }
}

} // namespace
} // namespace nacre
