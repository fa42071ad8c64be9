#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/exemplar/normal_method.h"
#include "acquisition/normals/lambertian_solver.h"
#include "acquisition/normals/normals.h"
#include "engine/files/error.h"
#include "engine/files/measures.h"

namespace nacre {
namespace {

std::vector<Light> ringOfLights(int count)
{
    std::vector<Light> lights;
    for (int i = 0; i < count; ++i) {
        const float phi = 2.399963f * i, theta = 0.8f * std::sqrt((i + 0.5f) / count);
        lights.push_back({{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)},
                          glm::vec3(1.0f + 0.2f * std::sin(3.0f * i), 1.0f, 0.8f)});
    }
    return lights;
}

// A Lambertian sphere: attached shadows are black.
Observations lambertianSphere(const std::vector<Light>& lights, int size, std::vector<glm::vec3>& truth, float albedo)
{
    Observations block;
    block.lightCount = lights.size();
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const float nx = (2 * x + 1.0f) / size - 1, ny = 1 - (2 * y + 1.0f) / size;
            const float r2 = nx * nx + ny * ny;
            if (r2 >= 1) {
                continue;
            }
            truth.emplace_back(nx, ny, std::sqrt(1 - r2));
            block.pixels.push_back(y * size + x);
            for (const Light& light : lights) {
                block.radiance.push_back(albedo * light.irradiance *
                                         std::max(0.0f, glm::dot(truth.back(), light.direction)));
            }
        }
    }
    block.saturated.assign(block.radiance.size(), 0);
    return block;
}

TEST(Normals, LambertianSphereWithShadowsDroppedIsExact)
{
    const std::vector<Light> lights = ringOfLights(24);
    std::vector<glm::vec3> truth;
    const Observations block = lambertianSphere(lights, 64, truth, 0.6f);
    NormalOptions options;
    options.method = NormalMethod::threshold;
    options.lowThreshold = 1e-6f;
    options.highThreshold = 10;
    const std::vector<PixelNormal> normals =
        makeThresholdEstimator(lights, options)(intensitiesOf(block, lights)).pixels;
    size_t compared = 0;
    for (size_t p = 0; p < normals.size(); ++p) {
        if (normals[p].used >= 3 && normals[p].confidence > 0) {
            ++compared;
            EXPECT_LT(degreesBetween(normals[p].normal, truth[p]), 0.05);
            EXPECT_NEAR(normals[p].albedo / 0.6f, 1, 0.005);
        }
    }
    EXPECT_GT(compared, normals.size() * 95 / 100);
}

TEST(Normals, LeastSquaresIsExactWhereEveryLightReaches)
{
    const std::vector<Light> lights = ringOfLights(24);
    std::vector<glm::vec3> truth;
    const Observations block = lambertianSphere(lights, 64, truth, 0.6f);
    const std::vector<PixelNormal> normals = makeLeastSquaresEstimator(lights, {})(intensitiesOf(block, lights)).pixels;
    for (size_t p = 0; p < normals.size(); ++p) {
        const auto radiance = block.radianceOf(p);
        if (std::all_of(radiance.begin(), radiance.end(), [](const glm::vec3& r) { return r.y > 0; })) {
            EXPECT_LT(degreesBetween(normals[p].normal, truth[p]), 0.01);
        }
    }
}

TEST(NormalsSlow, SameBytesForOneAndTwoThreadsByEveryMethod)
{
    const std::vector<Light> lights = ringOfLights(12);
    std::vector<glm::vec3> truth;
    const Observations block = lambertianSphere(lights, 48, truth, 0.4f);
    const Intensities intensities = intensitiesOf(block, lights);
    for (const char* method : {"least-squares", "threshold", "two-step", "ransac", "consensus", "exemplar", "auto"}) {
        NormalOptions one, two;
        one.method = two.method = normalMethodFromName(method);
        one.threads = 1;
        two.threads = 2;
        NormalReport reportOne, reportTwo;
        const NormalBlock a = makeNormalEstimator(intensities, lights, one, reportOne)(intensities);
        const NormalBlock b = makeNormalEstimator(intensities, lights, two, reportTwo)(intensities);
        EXPECT_EQ(a.verdicts, b.verdicts) << method;
        EXPECT_EQ(reportOne.findings, reportTwo.findings) << method;
        for (size_t p = 0; p < a.pixels.size(); ++p) {
            EXPECT_EQ(a.pixels[p].normal, b.pixels[p].normal) << method;
            EXPECT_EQ(a.pixels[p].confidence, b.pixels[p].confidence) << method;
        }
    }
}

TEST(NormalsSlow, WhatTheSensorClippedIsLookedAtByNoMethod)
{
    const std::vector<Light> lights = ringOfLights(18);
    std::vector<glm::vec3> truth;
    Observations dim = lambertianSphere(lights, 32, truth, 0.4f);
    for (size_t i = 0; i < dim.saturated.size(); ++i) {
        dim.saturated[i] = i * 7 % 11 == 0;
    }
    Observations bright = dim;
    for (size_t i = 0; i < bright.saturated.size(); ++i) {
        bright.radiance[i] *= bright.saturated[i] ? 5.0f : 1.0f;
    }
    for (const char* method : {"least-squares", "threshold", "two-step", "ransac", "consensus", "exemplar", "auto"}) {
        NormalOptions options;
        options.method = normalMethodFromName(method);
        const auto estimate = [&](const Observations& block) {
            const Intensities intensities = intensitiesOf(block, lights);
            NormalReport report;
            return makeNormalEstimator(intensities, lights, options, report)(intensities);
        };
        const NormalBlock a = estimate(dim), b = estimate(bright);
        EXPECT_EQ(a.verdicts, b.verdicts) << method;
        for (size_t p = 0; p < a.pixels.size(); ++p) {
            EXPECT_EQ(a.pixels[p].normal, b.pixels[p].normal) << method;
        }
        for (size_t i = 0; i < a.verdicts.size(); ++i) {
            EXPECT_EQ(a.verdicts[i] == Verdict::saturated, dim.saturated[i] != 0) << method;
        }
    }
}

// Highlights on `tenths` of the lights and shadows on as many, other lights at every pixel.
void spoil(Intensities& intensities, size_t tenths)
{
    for (size_t p = 0; p < intensities.pixelCount(); ++p) {
        for (size_t i = 0; i < intensities.lightCount; ++i) {
            float& value = intensities.values[p * intensities.stride + i];
            const size_t kind = (7 * p + 3 * i) % 10;
            value = kind < tenths ? 3 * value + 0.2f : kind < 2 * tenths ? 0.05f * value : value;
        }
    }
}

TEST(Normals, RobustMethodsForgetOutliersThatLeastSquaresTakesForData)
{
    const std::vector<Light> lights = ringOfLights(30);
    std::vector<glm::vec3> truth;
    const Observations block = lambertianSphere(lights, 48, truth, 0.5f);
    const Intensities clean = intensitiesOf(block, lights);
    Intensities intensities = clean;
    spoil(intensities, 2);
    const auto meanError = [&](NormalMethod method) {
        NormalOptions options;
        options.method = method;
        NormalReport report;
        const NormalBlock result = makeNormalEstimator(intensities, lights, options, report)(intensities);
        double sum = 0;
        for (size_t p = 0; p < truth.size(); ++p) {
            sum += result.pixels[p].confidence > 0 ? degreesBetween(result.pixels[p].normal, truth[p]) : 90;
        }
        return sum / static_cast<double>(truth.size());
    };
    const double leastSquares = meanError(NormalMethod::leastSquares);
    EXPECT_GT(leastSquares, 5);
    EXPECT_LT(meanError(NormalMethod::consensus), 0.5);
    EXPECT_LT(meanError(NormalMethod::ransac), 3);
    // Exemplars take outliers for a gloss that they look for.
    EXPECT_LT(meanError(NormalMethod::exemplar), leastSquares / 3);
    // The paper's two steps take the median of all triples' diffuse factors, most of which hold an outlier above.
    intensities = clean;
    spoil(intensities, 1);
    EXPECT_LT(meanError(NormalMethod::twoStep), 5);
}

TEST(Normals, VerdictsNameShadowAndHighlight)
{
    const std::vector<Light> lights = ringOfLights(30);
    std::vector<glm::vec3> truth;
    const Observations block = lambertianSphere(lights, 32, truth, 0.5f);
    Intensities intensities = intensitiesOf(block, lights);
    const Intensities clean = intensities;
    spoil(intensities, 2);
    const NormalBlock result = makeConsensusEstimator(lights, {})(intensities);
    size_t right = 0, all = 0;
    for (size_t p = 0; p < truth.size(); ++p) {
        for (size_t i = 0; i < lights.size(); ++i) {
            if (clean.ofPixel(p)[i] < 0.1f) {
                continue; // grazing: dark under any verdict
            }
            const size_t kind = (7 * p + 3 * i) % 10;
            const Verdict expected = kind < 2 ? Verdict::highlight : kind < 4 ? Verdict::shadow : Verdict::used;
            right += result.verdicts[p * lights.size() + i] == expected;
            ++all;
        }
    }
    EXPECT_GT(static_cast<double>(right) / static_cast<double>(all), 0.98);
}

TEST(Normals, ConfidenceFallsWithNoiseAndIsZeroWhereLightsAreNearlyCoplanar)
{
    const std::vector<Light> lights = ringOfLights(20);
    std::vector<glm::vec3> truth;
    const Observations block = lambertianSphere(lights, 24, truth, 0.5f);
    Intensities noisy = intensitiesOf(block, lights);
    const size_t middle = truth.size() / 2;
    const float clean = makeConsensusEstimator(lights, {})(noisy).pixels[middle].confidence;
    for (size_t k = 0; k < noisy.values.size(); ++k) {
        noisy.values[k] *= 0.7f + 0.6f * static_cast<float>((k * 2654435769u >> 8) % 1024) / 1023;
    }
    EXPECT_GT(clean, 0.99f);
    EXPECT_LT(makeConsensusEstimator(lights, {})(noisy).pixels[middle].confidence, 0.9f);
    std::vector<Light> plane = lights;
    for (Light& light : plane) {
        light.direction = glm::normalize(glm::vec3(light.direction.x, 0.001f * light.direction.y, light.direction.z));
    }
    EXPECT_EQ(makeConsensusEstimator(plane, {})(intensitiesOf(block, plane)).pixels[middle].confidence, 0);
}

TEST(Normals, FewerThanThreeOrCoplanarObservationsGiveNone)
{
    const std::vector<Light> lights = ringOfLights(8);
    const LambertianSolver solver(lights);
    const std::vector<float> intensities(8, 0.5f);
    EXPECT_EQ(solver.solve(intensities, std::vector<float>{1, 1, 0, 0, 0, 0, 0, 0}).confidence, 0);
    const std::vector<Light> plane = {{{1, 0, 0}}, {{0, 0, 1}}, {glm::normalize(glm::vec3(1, 0, 1))}};
    EXPECT_EQ(LambertianSolver(plane).solve(std::vector<float>(3, 0.5f), std::vector<float>(3, 1)).confidence, 0);
    EXPECT_EQ(solver.solve(std::vector<float>(8, 0.0f)).confidence, 0) << "a black pixel has no normal";
}

TEST(Normals, MethodsAreNamed)
{
    EXPECT_EQ(nameOf(normalMethodFromName("threshold")), "threshold");
    try {
        normalMethodFromName("magic");
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.exitCode(), Error::kUsage);
        EXPECT_NE(std::string(e.what()).find("auto, least-squares, threshold, two-step, ransac, consensus, exemplar"),
                  std::string::npos);
    }
}

} // namespace
} // namespace nacre
