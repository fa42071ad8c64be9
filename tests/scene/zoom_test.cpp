#include <numeric>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/surface/zoom.h"

namespace nacre {
namespace {

constexpr int kSide = 64;

// Two materials, left and right, each of its own factor, on a sphere.
Surface halvedSphere()
{
    Surface surface = transferredSurface(sphereNormalMap(kSide), Material{});
    surface.albedo = Image(kSide, kSide, 3, 0.5f);
    for (size_t i = 0; i < surface.labels.size(); ++i) {
        const bool isRight = i % kSide >= kSide / 2;
        if (isRight && surface.labels[i] == 0) {
            surface.labels[i] = 1;
        }
        std::fill_n(&surface.albedo.values[3 * i], 3, isRight ? 1.25f : 0.75f);
    }
    return surface;
}

double sumOf(const std::vector<uint8_t>& codes)
{
    return std::accumulate(codes.begin(), codes.end(), 0.0) / 255;
}

TEST(Zoom, NormalsBetweenPixelsAreTheSpheres)
{
    constexpr float kScale = 5;
    const Surface sphere = transferredSurface(sphereNormalMap(kSide), Material{});
    const MagnifiedSurface near = magnified(sphere, wholeZoom(kSide, kSide, kScale));
    size_t seen = 0;
    for (size_t i = 0; i < near.cover.size(); ++i) {
        const glm::vec2 pixel(i % (kSide * 5), i / (kSide * 5));
        const glm::vec2 p = 2.0f * ((pixel + 0.5f) / kScale - 0.5f) / float(kSide - 1) - 1.0f;
        const float square = glm::dot(p, p);
        if (square > 0.8f) { // nearer to the rim normals turn within a pixel
            continue;
        }
        const glm::vec3 truth(p.x, -p.y, std::sqrt(1 - square)), n = near.pixels.normals.normals[i];
        ASSERT_NEAR(glm::length(n), 1, 1e-5);
        ASSERT_GT(glm::dot(n, truth), std::cos(0.01f)) << p.x << " " << p.y;
        ++seen;
    }
    EXPECT_GT(seen, near.cover.size() / 2);
}

TEST(Zoom, MaterialsDoNotMix)
{
    const MagnifiedSurface near = magnified(halvedSphere(), wholeZoom(kSide, kSide, 3));
    for (size_t i = 0; i < near.cover.size(); ++i) {
        if (near.cover[i] > 0) {
            const bool isRight = i % (kSide * 3) >= kSide * 3 / 2;
            ASSERT_EQ(near.pixels.labels[i], isRight ? 1 : 0);
            ASSERT_NEAR(near.pixels.albedo.values[3 * i], isRight ? 1.25f : 0.75f, 1e-5);
        }
    }
}

TEST(Zoom, NothingLiesBetweenTheSidesOfAFold)
{
    Surface fold = transferredSurface(NormalMap(8, 8), Material{});
    const glm::vec3 left(-0.8f, 0, 0.6f), right(0.8f, 0, 0.6f);
    for (size_t i = 0; i < fold.labels.size(); ++i) {
        fold.labels[i] = 0;
        fold.normals.confidence[i] = 1;
        fold.normals.normals[i] = i % 8 < 4 ? left : right;
    }
    const MagnifiedSurface near = magnified(fold, wholeZoom(8, 8, 5));
    for (size_t i = 0; i < near.cover.size(); ++i) {
        ASSERT_LT(glm::distance(near.pixels.normals.normals[i], i % 40 < 20 ? left : right), 1e-5f) << i;
    }
}

// Of pixels as they are, corners lie half a pixel from it.
TEST(Zoom, AFoldIsALineAndNotPixelsStairs)
{
    constexpr int kScale = 8;
    const glm::vec2 across = glm::normalize(glm::vec2(1, 0.3f));
    const auto right = [&](const glm::vec2& place) { return glm::dot(place - 8.0f, across); }; // of the fold, in pixels
    Surface fold = transferredSurface(NormalMap(16, 16), Material{});
    for (size_t i = 0; i < fold.labels.size(); ++i) {
        fold.labels[i] = 0;
        fold.normals.confidence[i] = 1;
        fold.normals.normals[i] = {right({i % 16 + 0.5f, i / 16 + 0.5f}) < 0 ? -0.8f : 0.8f, 0, 0.6f};
    }
    const MagnifiedSurface near = magnified(fold, wholeZoom(16, 16, kScale));
    float farthest = 0;
    for (size_t i = 0; i < near.cover.size(); ++i) {
        const float x = right((glm::vec2(i % 128, i / 128) + 0.5f) / float(kScale));
        const bool isOff = (near.pixels.normals.normals[i].x > 0) != (x > 0);
        farthest = isOff ? std::max(farthest, std::abs(x)) : farthest;
    }
    EXPECT_LT(farthest, 0.42f);
}

TEST(Zoom, TheOutlineStaysWhereItIs)
{
    const Surface surface = halvedSphere();
    const double pixels = std::accumulate(surface.normals.confidence.begin(), surface.normals.confidence.end(), 0.0);
    for (const float scale : {1.3f, 2.0f, 6.0f}) {
        const MagnifiedSurface near = magnified(surface, wholeZoom(kSide, kSide, scale));
        EXPECT_NEAR(sumOf(near.cover) / (scale * scale), pixels, 0.005 * pixels) << scale;
    }
    // A straight one lies between the last pixel that has a normal and the first that has none.
    Surface half = transferredSurface(NormalMap(8, 8), Material{});
    for (size_t i = 0; i < half.labels.size(); ++i) {
        half.labels[i] = i % 8 < 5 ? 0 : Surface::kNoMaterial;
        half.normals.confidence[i] = 1;
        half.normals.normals[i] = {0, 0, 1};
    }
    const MagnifiedSurface near = magnified(half, wholeZoom(8, 8, 4));
    for (size_t i = 0; i < near.cover.size(); ++i) {
        ASSERT_EQ(near.cover[i] > 127, i % 32 < 20);
    }
}

TEST(Zoom, APartIsACutOfTheWhole)
{
    const Surface surface = halvedSphere();
    const MagnifiedSurface whole = magnified(surface, wholeZoom(kSide, kSide, 4));
    const MagnifiedSurface part = magnified(surface, {.scale = 4, .origin = {10, 20}, .size = {40, 24}});
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 40; ++x) {
            const size_t i = part.pixels.normals.index(x, y), j = whole.pixels.normals.index(x + 40, y + 80);
            ASSERT_EQ(part.pixels.normals.normals[i], whole.pixels.normals.normals[j]);
            ASSERT_EQ(part.cover[i], whole.cover[j]);
        }
    }
}

TEST(Zoom, EvenAreasStayAndLightIsKept)
{
    for (const float scale : {0.5f, 0.37f, 0.9f, 0.05f}) {
        const Zoom zoom = wholeZoom(40, 30, scale);
        const Image even(40, 30, 3, 77.0f / 255);
        for (const float code : reducedCodes(even, zoom).values) {
            ASSERT_EQ(code, 77.0f / 255);
        }
    }
    Image spots(40, 30, 3);
    for (size_t i = 0; i < spots.values.size(); i += 7) {
        spots.values[i] = static_cast<float>(i % 5);
    }
    const Image half = reducedRadiance(spots, wholeZoom(40, 30, 0.5f));
    EXPECT_NEAR(std::accumulate(half.values.begin(), half.values.end(), 0.0),
                std::accumulate(spots.values.begin(), spots.values.end(), 0.0) / 4, 1e-3);
}

} // namespace
} // namespace nacre
