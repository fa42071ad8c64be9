// Light that an object throws on itself: in a spherical bowl it is known exactly; from a convex object none is
// invented.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/exemplar/normal_method.h"
#include "acquisition/self_light/self_light.h"
#include "engine/files/hash_random.h"
#include "engine/files/measures.h"

namespace nacre::test {
namespace {

constexpr int kSide = 60; // pixels
constexpr float kRho = 0.8f;

float uniform01(uint64_t a, uint64_t b, uint64_t c)
{
    return static_cast<float>(unitFromHash(hashOf(hashOf(a, b), c)));
}

std::vector<Light> ringLights()
{
    std::vector<Light> lights;
    for (const float polar : {15.0f, 38.0f, 58.0f}) {
        for (int k = 0; k < 8; ++k) {
            const float p = glm::radians(polar), a = glm::radians(45.0f * static_cast<float>(k) + polar);
            lights.push_back({{std::sin(p) * std::cos(a), std::sin(p) * std::sin(a), std::cos(p)}, {1, 2, 1}});
        }
    }
    return lights;
}

// Photographs of something that fills a square picture; what a pixel shows is in units of its irradiance.
struct Scene {
    Observations seen;
    std::vector<glm::vec3> truth; // per pixel
    std::vector<Light> lights = ringLights();

    std::vector<PixelNormal> trueNormals() const
    {
        std::vector<PixelNormal> normals;
        for (const glm::vec3& normal : truth) {
            normals.push_back({normal, 1, 1, 24});
        }
        return normals;
    }
};

using Shown = std::function<float(size_t pixel, size_t light)>;

// normalAt answers 0 beside the object; x and y in (-1, 1), y up.
Scene shapeOf(const std::function<glm::vec3(float, float)>& normalAt)
{
    Scene scene;
    scene.seen.lightCount = scene.lights.size();
    scene.seen.width = kSide;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const glm::vec3 normal =
                normalAt((2 * static_cast<float>(x) + 1) / kSide - 1, 1 - (2 * static_cast<float>(y) + 1) / kSide);
            if (normal != glm::vec3(0)) {
                scene.seen.pixels.push_back(static_cast<uint32_t>(y * kSide + x));
                scene.truth.push_back(normal);
            }
        }
    }
    return scene;
}

void photograph(Scene& scene, const Shown& shown)
{
    for (size_t p = 0; p < scene.truth.size(); ++p) {
        for (size_t i = 0; i < scene.lights.size(); ++i) {
            scene.seen.radiance.push_back(shown(p, i) * scene.lights[i].irradiance);
            scene.seen.saturated.push_back(0);
        }
    }
}

// The inside of a sphere up to 75 degrees from its bottom. Form factors inside a sphere are A / 4 pi R^2 wherever the
// receiver is, so that under each light the same arrives everywhere: rho k M, with k the cap's share of the sphere and
// M = D / (1 - rho k) the mean of what it shows, D that of what the light alone makes it show.
struct Bowl : Scene {
    double share = 0;            // k
    std::vector<float> direct;   // [pixel * lights + light]
    std::vector<float> indirect; // per light
};

Bowl bowlScene()
{
    const float wide = glm::radians(75.0f), rim = -std::cos(wide), radius = 1 / std::sin(wide);
    Bowl bowl;
    static_cast<Scene&>(bowl) = shapeOf([&](float x, float y) {
        const float squared = (x * x + y * y) / (radius * radius), height = std::sqrt(std::max(0.0f, 1 - squared));
        return height > -rim ? glm::vec3(-x / radius, -y / radius, height) : glm::vec3(0);
    });
    bowl.share = (1 - std::cos(wide)) / 2;
    for (const glm::vec3& normal : bowl.truth) {
        for (const Light& light : bowl.lights) {
            // The ray from -normal towards the light meets the sphere again above the rim, or is stopped.
            const float facing = glm::dot(normal, light.direction);
            const glm::vec3 exit = -normal + 2 * facing * light.direction;
            bowl.direct.push_back(facing > 0 && exit.z > rim ? kRho / std::numbers::pi_v<float> * facing : 0.0f);
        }
    }
    const size_t n = bowl.lights.size();
    for (size_t i = 0; i < n; ++i) {
        double sum = 0, area = 0;
        for (size_t p = 0; p < bowl.truth.size(); ++p) {
            sum += bowl.direct[p * n + i] / bowl.truth[p].z;
            area += 1 / bowl.truth[p].z;
        }
        bowl.indirect.push_back(static_cast<float>(kRho * bowl.share * sum / area / (1 - kRho * bowl.share)));
    }
    photograph(bowl, [&](size_t p, size_t i) { return bowl.direct[p * n + i] + bowl.indirect[i]; });
    return bowl;
}

NormalMap mapOf(const Scene& scene)
{
    NormalMap map(kSide, kSide);
    for (size_t p = 0; p < scene.truth.size(); ++p) {
        map.normals[scene.seen.pixels[p]] = scene.truth[p];
        map.confidence[scene.seen.pixels[p]] = 1;
    }
    return map;
}

std::vector<PixelNormal> estimated(const Observations& seen, const std::vector<Light>& lights)
{
    const Intensities intensities = intensitiesOf(seen, lights);
    NormalReport report;
    return makeNormalEstimator(intensities, lights, {}, report)(intensities).pixels;
}

double meanError(const std::vector<PixelNormal>& normals, const Scene& scene)
{
    double sum = 0;
    for (size_t p = 0; p < normals.size(); ++p) {
        sum += degreesBetween(normals[p].normal, scene.truth[p]);
    }
    return sum / static_cast<double>(normals.size());
}

TEST(SelfLight, FormFactorsInsideASphereAreTheSameEverywhere)
{
    const Bowl bowl = bowlScene();
    const PatchGrid grid = makePatches(mapOf(bowl), 1);
    const auto passages = passagesBetween(grid, 1);
    double sum = 0;
    for (size_t i = 0; i < passages.size(); ++i) {
        double factors = 0;
        for (const Passage& passage : passages[i]) {
            factors += glm::dot(grid.patches[i].normal, passage.flow);
        }
        EXPECT_LE(factors, 1.0001);
        if (grid.patches[i].normal.z > 0.5f) {
            EXPECT_NEAR(factors, bowl.share, 0.15 * bowl.share) << i;
        }
        sum += factors / static_cast<double>(passages.size());
    }
    EXPECT_NEAR(sum, bowl.share, 0.1 * bowl.share);
}

TEST(SelfLight, WhatOnePatchSendsTheOtherSendsBack)
{
    const PatchGrid grid = makePatches(mapOf(bowlScene()), 1);
    const auto passages = passagesBetween(grid, 1);
    for (size_t i = 0; i < passages.size(); i += 7) {
        for (const Passage& passage : passages[i]) {
            const auto& back = passages[passage.from];
            const auto found =
                std::find_if(back.begin(), back.end(), [&](const Passage& other) { return other.from == i; });
            ASSERT_NE(found, back.end());
            const Patch &a = grid.patches[i], &b = grid.patches[passage.from];
            const float there = a.area * glm::dot(a.normal, passage.flow),
                        here = b.area * glm::dot(b.normal, found->flow);
            EXPECT_NEAR(there, here, 1e-4f * std::max(there, here));
        }
    }
}

TEST(SelfLight, AWallHidesWhatIsBehindIt)
{
    // Two slopes that face each other across a ridge, and across nothing.
    const auto facingPairs = [](bool ridge) {
        NormalMap map(24, 6);
        for (int y = 0; y < map.height; ++y) {
            for (int x = 0; x < map.width; ++x) {
                const float slope = x < 6 ? -1 : x >= 18 ? 1 : !ridge || x < 9 || x >= 15 ? 0 : x < 12 ? 4 : -4;
                map.normals[map.index(x, y)] = glm::normalize(glm::vec3(-slope, 0, 1));
                map.confidence[map.index(x, y)] = 1;
            }
        }
        const PatchGrid grid = makePatches(map, 1);
        size_t pairs = 0;
        const auto passages = passagesBetween(grid, 1);
        for (size_t i = 0; i < passages.size(); ++i) {
            for (const Passage& passage : passages[i]) {
                pairs += grid.patches[i].position.x < 6 && grid.patches[passage.from].position.x > 17;
            }
        }
        return pairs;
    };
    EXPECT_GT(facingPairs(false), 0u);
    EXPECT_EQ(facingPairs(true), 0u);
}

TEST(SelfLight, IsWhatTheInsideOfASphereThrowsOnItself)
{
    const Bowl bowl = bowlScene();
    const auto self = findSelfLight(bowl.seen, bowl.trueNormals(), bowl.lights, 1);
    ASSERT_TRUE(self);
    EXPECT_NEAR(self->strength, std::numbers::pi, 0.15 * std::numbers::pi);
    EXPECT_GT(self->explained, 0.8);
    const Observations direct = withoutSelfLight(*self, bowl.seen, bowl.lights, 1);
    const size_t n = bowl.lights.size();
    double left = 0, all = 0;
    for (size_t p = 0; p < bowl.truth.size(); ++p) {
        for (size_t i = 0; i < n; ++i) {
            left += std::abs(direct.radianceOf(p)[i].y / 2 - bowl.direct[p * n + i]);
            all += bowl.indirect[i];
        }
    }
    EXPECT_LT(left, 0.15 * all);
}

TEST(SelfLight, ABowlsNormalsAreTwiceAsGoodWithoutIt)
{
    const Bowl bowl = bowlScene();
    const std::vector<PixelNormal> before = estimated(bowl.seen, bowl.lights);
    const auto self = findSelfLight(bowl.seen, before, bowl.lights, 0);
    ASSERT_TRUE(self);
    const std::vector<PixelNormal> after = estimated(withoutSelfLight(*self, bowl.seen, bowl.lights, 0), bowl.lights);
    RecordProperty("before", std::to_string(meanError(before, bowl)));
    RecordProperty("after", std::to_string(meanError(after, bowl)));
    EXPECT_LT(meanError(after, bowl), 0.5 * meanError(before, bowl));
}

TEST(SelfLight, NoneIsFoundOnConvexThings)
{
    const auto sphere = [](float x, float y) {
        const float squared = x * x + y * y;
        return squared < 0.98f ? glm::vec3(x, y, std::sqrt(1 - squared)) : glm::vec3(0);
    };
    const auto sheet = [](float, float) { return glm::vec3(0.6f, 0, 0.8f); };
    for (const auto& shape : {std::function<glm::vec3(float, float)>(sphere), {sheet}}) {
        for (const float stray : {0.0f, 0.02f}) {
            Scene scene = shapeOf(shape);
            photograph(scene, [&](size_t p, size_t i) {
                const float lit = std::max(0.0f, glm::dot(scene.truth[p], scene.lights[i].direction));
                return 0.25f * lit + stray + 0.01f * (uniform01(7, p, i) - 0.5f);
            });
            // Normals err as those of photographs do.
            std::vector<PixelNormal> normals = scene.trueNormals();
            for (size_t p = 0; p < normals.size(); ++p) {
                const glm::vec3 error(uniform01(8, p, 0) - 0.5f, uniform01(8, p, 1) - 0.5f, 0);
                normals[p].normal = glm::normalize(normals[p].normal + 0.05f * error);
            }
            EXPECT_FALSE(findSelfLight(scene.seen, normals, scene.lights, 1));
        }
    }
}

TEST(SelfLight, TornSurfacesStayWithinBounds)
{
    const Bowl bowl = bowlScene();
    std::vector<PixelNormal> normals = bowl.trueNormals();
    for (size_t p = 0; p < normals.size(); ++p) {
        const uint32_t x = bowl.seen.pixels[p] % kSide;
        if (x % 20 < 3 || p % 11 == 0) {
            normals[p] = PixelNormal{};
        } else if (p % 40 == 0) {
            normals[p].normal = glm::normalize(glm::vec3(uniform01(1, p, 0) - 0.5f, uniform01(1, p, 1) - 0.5f, 0.02f));
        }
    }
    std::optional<SelfLight> self = findSelfLight(bowl.seen, normals, bowl.lights, 1);
    ASSERT_TRUE(self);
    self->strength *= 1000;
    const Observations direct = withoutSelfLight(*self, bowl.seen, bowl.lights, 1);
    for (size_t k = 0; k < direct.radiance.size(); ++k) {
        ASSERT_LE(direct.radiance[k].y, bowl.seen.radiance[k].y);
        ASSERT_GE(direct.radiance[k].y, 0.999f * (1 - kMostSelfLight) * bowl.seen.radiance[k].y);
    }
    EXPECT_FALSE(findSelfLight(bowl.seen, std::vector<PixelNormal>(normals.size()), bowl.lights, 1));
    EXPECT_FALSE(findSelfLight({}, {}, bowl.lights, 1));
}

TEST(SelfLight, IsTheSameForAnyNumberOfThreads)
{
    const Bowl bowl = bowlScene();
    const auto one = findSelfLight(bowl.seen, bowl.trueNormals(), bowl.lights, 1),
               three = findSelfLight(bowl.seen, bowl.trueNormals(), bowl.lights, 3);
    ASSERT_TRUE(one && three);
    EXPECT_EQ(withoutSelfLight(*one, bowl.seen, bowl.lights, 1).radiance,
              withoutSelfLight(*three, bowl.seen, bowl.lights, 3).radiance);
}

} // namespace
} // namespace nacre::test
