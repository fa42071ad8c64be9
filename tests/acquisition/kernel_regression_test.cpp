#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/brdf/bake.h"
#include "acquisition/brdf/kernel_regression.h"
#include "engine/files/error.h"

namespace nacre {
namespace {

// A fixed scattering of the unit cube (the R3 sequence of Roberts, 2018).
BrdfSamples scatteredSamples(size_t count, int coordinates = kHalfDifference)
{
    BrdfSamples samples;
    samples.domain = {coordinates, 0.4f};
    for (size_t i = 0; i < count; ++i) {
        const double n = static_cast<double>(i) + 1;
        samples.unit.emplace_back(std::fmod(0.8191725134 * n, 1), std::fmod(0.6710436067 * n, 1),
                                  std::fmod(0.5497004779 * n, 1));
        samples.values.emplace_back(0.3f, 0.2f, 0.1f);
        samples.weights.push_back(0.2f + 0.8f * samples.unit.back().x);
    }
    return samples;
}

TEST(KernelRegression, ConstantDataInterpolateToTheConstant)
{
    const BrdfSamples samples = scatteredSamples(500);
    const KernelRegression regression(samples, 25);
    for (const glm::vec3& unit : scatteredSamples(64).unit) {
        EXPECT_LT(glm::length(regression.evaluate(1.0f - unit).value - glm::vec3(0.3f, 0.2f, 0.1f)), 1e-6f);
    }
}

TEST(KernelRegression, AQueryAtASampleWithOneNeighbourReturnsIt)
{
    BrdfSamples samples = scatteredSamples(200);
    for (size_t i = 0; i < samples.size(); ++i) {
        samples.values[i] = glm::vec3(static_cast<float>(i));
    }
    const KernelRegression regression(samples, 1);
    for (size_t i = 0; i < samples.size(); ++i) {
        const InterpolatedValue value = regression.evaluate(samples.unit[i]);
        EXPECT_FLOAT_EQ(value.value.x, static_cast<float>(i));
        EXPECT_EQ(value.nearest, 0);
    }
}

TEST(KernelRegression, DegenerateSamplesAreDefined)
{
    BrdfSamples same = scatteredSamples(60);
    for (glm::vec3& unit : same.unit) {
        unit = {0.5f, 0.5f, 0.5f};
    }
    const glm::vec3 expected(0.3f, 0.2f, 0.1f);
    for (const glm::vec3 query : {glm::vec3(0.5f), glm::vec3(0), glm::vec3(1)}) {
        EXPECT_LT(glm::length(KernelRegression(same, 25).evaluate(query).value - expected), 1e-6f);
        EXPECT_LT(glm::length(KernelRegression(scatteredSamples(1), 25).evaluate(query).value - expected), 1e-6f);
        const BrdfSamples few = scatteredSamples(10);
        EXPECT_LT(glm::length(KernelRegression(few, 25).evaluate(query).value - expected), 1e-6f);
    }
    const BrdfSamples none = scatteredSamples(0);
    EXPECT_THROW(KernelRegression(none, 25), Error);
    EXPECT_THROW(makeInterpolant(same, {.k = 0}), Error);
}

TEST(KernelRegression, StaysWithinWhatTheNeighboursShow)
{
    BrdfSamples samples = scatteredSamples(300);
    for (size_t i = 0; i < samples.size(); ++i) {
        samples.values[i] = glm::vec3(std::exp(-20 * samples.unit[i].x));
    }
    const KernelRegression regression(samples, 5);
    for (const glm::vec3& unit : scatteredSamples(100).unit) {
        const float value = regression.evaluate(1.0f - unit).value.x;
        EXPECT_GE(value, 0);
        EXPECT_LE(value, 1);
    }
}

TEST(Bake, CoordinatesAgreeOnLambert)
{
    BakeOptions options;
    options.size = {12, 8, 10};
    const glm::vec3 l = glm::normalize(glm::vec3(0.3f, 0.2f, 0.9f)), v(0, 0, 1);
    const glm::vec3 n = glm::normalize(glm::vec3(-0.2f, 0.4f, 0.8f));
    const BakedBrdf half = bakeBrdf(scatteredSamples(400), InterpolationOptions{}, options);
    const glm::vec3 a = evaluateTable(half.table, n, l, v).value;
    for (const int coordinates : {kNatural, kOneWay}) {
        const BakedBrdf other = bakeBrdf(scatteredSamples(400, coordinates), InterpolationOptions{}, options);
        EXPECT_LT(glm::length(a - evaluateTable(other.table, n, l, v).value), 1e-6f) << nameOfCoordinates(coordinates);
    }
    EXPECT_LT(glm::length(a - glm::vec3(0.3f, 0.2f, 0.1f)), 1e-6f);
}

TEST(Bake, CoverageKnowsWhereSamplesAre)
{
    BrdfSamples samples = scatteredSamples(2000);
    for (glm::vec3& unit : samples.unit) {
        unit.y *= 0.5f; // nothing in the upper half of thetaD
    }
    BakeOptions options;
    options.size = {40, 21, 40};
    const BakedBrdf baked = bakeBrdf(samples, InterpolationOptions{}, options);
    EXPECT_GT(baked.table.confidence[baked.table.index(30, 4, 20)], 0.9f);
    EXPECT_LT(baked.table.confidence[baked.table.index(30, 20, 20)], 0.9f);
    EXPECT_GT(baked.coverage.distance[baked.table.index(30, 20, 20)], 0.15f);
    double counted = 0;
    for (const float count : baked.coverage.count) {
        counted += count;
    }
    EXPECT_EQ(counted, 2000);
}

TEST(Bake, SameBytesForOneAndTwoThreads)
{
    BakeOptions one, two;
    one.size = two.size = {16, 9, 8};
    one.threads = 1;
    two.threads = 2;
    BrdfSamples samples = scatteredSamples(3000);
    for (size_t i = 0; i < samples.size(); ++i) {
        samples.values[i] = glm::vec3(std::sin(9 * samples.unit[i].x), samples.unit[i].y, 1);
    }
    const BakedBrdf a = bakeBrdf(samples, InterpolationOptions{}, one),
                    b = bakeBrdf(samples, InterpolationOptions{}, two);
    EXPECT_EQ(a.table.values, b.table.values);
    EXPECT_EQ(a.table.confidence, b.table.confidence);
}

} // namespace
} // namespace nacre
