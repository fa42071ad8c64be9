#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/normals.h"
#include "engine/scene/error.h"
#include "engine/scene/measures.h"

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
    const std::vector<PixelNormal> normals = estimateNormals(block, lights, options);
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
    const std::vector<PixelNormal> normals = estimateNormals(block, lights, {});
    for (size_t p = 0; p < normals.size(); ++p) {
        const auto radiance = block.radianceOf(p);
        if (std::all_of(radiance.begin(), radiance.end(), [](const glm::vec3& r) { return r.y > 0; })) {
            EXPECT_LT(degreesBetween(normals[p].normal, truth[p]), 0.01);
        }
    }
}

TEST(Normals, SameBytesForOneAndTwoThreads)
{
    const std::vector<Light> lights = ringOfLights(12);
    std::vector<glm::vec3> truth;
    const Observations block = lambertianSphere(lights, 96, truth, 0.4f);
    NormalOptions one, two;
    one.method = two.method = NormalMethod::threshold;
    one.threads = 1;
    two.threads = 2;
    const auto a = estimateNormals(block, lights, one), b = estimateNormals(block, lights, two);
    for (size_t p = 0; p < a.size(); ++p) {
        EXPECT_EQ(a[p].normal, b[p].normal);
        EXPECT_EQ(a[p].albedo, b[p].albedo);
    }
}

TEST(Normals, FewerThanThreeOrCoplanarObservationsGiveNone)
{
    const std::vector<Light> lights = ringOfLights(8);
    const LambertianSolver solver(lights);
    const std::vector<float> intensities(8, 0.5f);
    EXPECT_EQ(solver.solve(intensities, std::vector<uint8_t>{1, 1, 0, 0, 0, 0, 0, 0}).confidence, 0);
    const std::vector<Light> plane = {{{1, 0, 0}}, {{0, 0, 1}}, {glm::normalize(glm::vec3(1, 0, 1))}};
    EXPECT_EQ(LambertianSolver(plane).solve(std::vector<float>(3, 0.5f), std::vector<uint8_t>(3, 1)).confidence, 0);
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
        EXPECT_NE(std::string(e.what()).find("least-squares, threshold"), std::string::npos);
    }
}

} // namespace
} // namespace nacre
