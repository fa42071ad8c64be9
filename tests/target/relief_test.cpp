// Surfaces turned as reliefs: what is known of them against the shape they were made of, and nothing beside it.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "engine/files/measures.h"
#include "engine/target/mesh_raster.h"
#include "engine/target/relief.h"
#include "tests/gpu/gpu_test.h"

namespace nacre::test {
namespace {

class ReliefTest : public GpuTest {
protected:
    static Surface turned(const Surface& front, const Turn& turn)
    {
        const Mesh mesh = reliefMesh(std::make_shared<const Surface>(front));
        return rasterisedMesh(*context, mesh, viewOf(mesh, turn));
    }
    static MeshView viewOf(const Mesh& mesh, const Turn& turn)
    {
        return reliefView(mesh,
                          {.width = mesh.front->normals.width, .height = mesh.front->normals.height, .turn = turn});
    }
};

Surface emptySurface(int width, int height)
{
    Surface surface;
    surface.normals = NormalMap(width, height);
    surface.height = Image(width, height, 1);
    surface.labels.assign(surface.height.pixelCount(), Surface::kNoMaterial);
    return surface;
}

constexpr int kSide = 200;
constexpr double kBall = 80;          // radius, pixels
constexpr double kLeastKnown = 0.2;   // z of the last normal that is known
constexpr double kPlaceOfBall = -5.5; // right of the picture's middle, of its middle

// The front of a sphere, of two materials left and right, its albedo a ramp from left to right.
Surface ballFront()
{
    Surface surface = emptySurface(kSide, kSide);
    surface.albedo = Image(kSide, kSide, 3, 1);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const glm::dvec2 at(x + 0.5 - 0.5 * kSide - kPlaceOfBall, 0.5 * kSide - y - 0.5);
            const double square = glm::dot(at, at) / (kBall * kBall), z = std::sqrt(std::max(0.0, 1 - square));
            if (z > kLeastKnown) {
                const size_t i = surface.normals.index(x, y);
                surface.normals.normals[i] = glm::vec3(at / kBall, z);
                surface.normals.confidence[i] = 0.5f;
                surface.height.values[i] = static_cast<float>(kBall * z);
                surface.labels[i] = at.x < 0 ? 3 : 4;
                surface.albedo.setRgb(x, y, glm::vec3(static_cast<float>(1 + at.x / kBall)));
            }
        }
    }
    return surface;
}

TEST_F(ReliefTest, AsItStandsItIsWhereItWas)
{
    const Surface front = ballFront();
    const Surface seen = turned(front, {});
    size_t known = 0;
    for (size_t i = 0; i < front.labels.size(); ++i) {
        if (seen.normals.confidence[i] > 0) {
            ++known;
            EXPECT_LT(degreesBetween(seen.normals.normals[i], front.normals.normals[i]), 1);
            EXPECT_EQ(seen.labels[i], front.labels[i]);
        }
    }
    const auto all = static_cast<size_t>(std::count(front.labels.begin(), front.labels.end(), 3) +
                                         std::count(front.labels.begin(), front.labels.end(), 4));
    EXPECT_GT(known, all * 97 / 100) << "but for half a pixel along the outline, where its steps are";
    EXPECT_LE(known, all);
}

// A sphere is one from everywhere, so that what a pixel must show follows from where it lies, and so does whether its
// place was seen from the front.
TEST_F(ReliefTest, TurnedItShowsWhatIsKnownAndNoHiddenSide)
{
    const Surface front = ballFront();
    for (const Turn& turn : {Turn{.yaw = 40}, Turn{.pitch = -50}, Turn{.yaw = -25, .pitch = 30, .roll = 70},
                             Turn{.yaw = 120}, Turn{.pitch = 180}}) {
        const Mesh mesh = reliefMesh(std::make_shared<const Surface>(front));
        const MeshView view = viewOf(mesh, turn);
        const Surface seen = turned(front, turn);
        const glm::dvec2 middle(view.pixelPoint(glm::vec3(kPlaceOfBall, 0, 0)));
        const double radius = kBall * view.pixelsPerUnit;
        size_t shown = 0, hidden = 0;
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                const glm::dvec2 at((x + 0.5 - middle.x) / radius, (middle.y - y - 0.5) / radius);
                const double z = std::sqrt(std::max(0.0, 1 - glm::dot(at, at)));
                const glm::dvec3 n(at, z), before = glm::transpose(matrixOf(turn)) * n;
                const size_t i = seen.normals.index(x, y);
                if (z < 0.15) {
                    continue; // a pixel holds many normals
                }
                if (before.z < kLeastKnown - 0.05) {
                    EXPECT_EQ(seen.normals.confidence[i], 0) << "its back at " << x << " " << y;
                    ++hidden;
                } else if (before.z > 0.6) { // no step
                    ASSERT_EQ(seen.normals.confidence[i], 0.5f) << x << " " << y;
                    EXPECT_LT(degreesBetween(seen.normals.normals[i], glm::vec3(n)), 1.5);
                    EXPECT_NEAR(seen.albedo.rgb(x, y).x, 1 + before.x, 0.03);
                    EXPECT_TRUE(std::abs(before.x) < 0.03 || seen.labels[i] == (before.x < 0 ? 3 : 4));
                    ++shown;
                }
            }
        }
        EXPECT_EQ(shown > 4000, matrixOf(turn)[2].z > 0.5) << shown << ": from behind there is little, or nothing";
        EXPECT_GT(hidden, 500u);
    }
}

// The middles of the pixels left of a line lie up to a pixel from it, those of its border by as much unevenly.
TEST(ReliefMesh, ABorderIsALineAndNotPixelsStairs)
{
    const glm::vec2 across = glm::normalize(glm::vec2(1, 0.4f));
    Surface front = emptySurface(60, 60);
    for (size_t i = 0; i < front.labels.size(); ++i) {
        const glm::vec2 at(static_cast<float>(i % 60) - 29.5f, 29.5f - static_cast<float>(i / 60));
        front.normals.normals[i] = {0, 0, 1};
        front.normals.confidence[i] = glm::dot(at, across) < 0 ? 1 : 0;
    }
    const Mesh mesh = reliefMesh(std::make_shared<const Surface>(front));
    std::vector<float> farthest(60, -1000); // of each row away from the picture's border, where corners are
    for (const uint32_t i : mesh.indices) {
        const glm::vec2 at(mesh.positions[i]);
        float& row = farthest[static_cast<size_t>(std::clamp(std::round(at.y + 29.5f), 0.0f, 59.0f))];
        row = std::max(row, glm::dot(at, across));
    }
    const auto [low, high] = std::minmax_element(farthest.begin() + 10, farthest.end() - 10);
    EXPECT_LT(*high - *low, 0.3f);
    EXPECT_GT(*low, -1);
    EXPECT_LE(*high, 0.01f) << "what is not known is not drawn";
}

// While it is turned it is drawn of fewer pixels: the same but for its outline and what lies between them.
TEST_F(ReliefTest, CoarselyItIsNearlyTheSame)
{
    const auto mesh = std::make_shared<const Mesh>(reliefMesh(std::make_shared<const Surface>(ballFront()), 1));
    const auto coarse = std::make_shared<const Mesh>(reliefMesh(mesh->front, 3));
    EXPECT_NEAR(static_cast<double>(coarse->triangleCount()) / static_cast<double>(mesh->triangleCount()), 1 / 9.0,
                0.02);
    EXPECT_EQ(coarseRelief(coarse), coarse) << "few enough";
    const Turn turn{.yaw = 30, .pitch = 10};
    const Surface fine = rasterisedMesh(*context, *mesh, viewOf(*mesh, turn)),
                  seen = rasterisedMesh(*context, *coarse, viewOf(*mesh, turn));
    size_t both = 0, one = 0;
    for (size_t i = 0; i < fine.labels.size(); ++i) {
        const bool inFine = fine.normals.confidence[i] > 0, inSeen = seen.normals.confidence[i] > 0;
        both += inFine && inSeen;
        one += inFine != inSeen;
        if (inFine && inSeen) {
            EXPECT_LT(degreesBetween(fine.normals.normals[i], seen.normals.normals[i]), 4) << "3 pixels are 2 to 10";
        }
    }
    EXPECT_LT(one, both / 15);
}

// A table above a floor: turned towards the side that is its edge's, a strip as wide as the edge is high shows nothing;
// turned away, the table hides as much of the floor.
TEST_F(ReliefTest, WhatJoinsAStepIsNotKnownAndHides)
{
    constexpr int kStepHeight = 40;
    Surface front = emptySurface(kSide, 40);
    for (int y = 4; y < 36; ++y) {
        for (int x = 10; x < kSide - 10; ++x) {
            const size_t i = front.normals.index(x, y);
            const bool isTable = x < kSide / 2;
            front.normals.normals[i] = {0, 0, 1};
            front.normals.confidence[i] = 1;
            front.height.values[i] = isTable ? kStepHeight : 0;
            front.labels[i] = isTable ? 0 : 1;
        }
    }
    for (const float yaw : {-30.0f, 30.0f}) {
        const Surface seen = turned(front, {.yaw = yaw});
        int lastOfTable = -1, firstOfFloor = kSide, floor = 0;
        for (int x = 0; x < kSide; ++x) {
            const size_t i = seen.normals.index(x, 20);
            if (seen.normals.confidence[i] > 0 && seen.labels[i] == 0) {
                lastOfTable = x;
            } else if (seen.normals.confidence[i] > 0) {
                firstOfFloor = std::min(firstOfFloor, x);
                ++floor;
            }
        }
        const double strip = 0.5 * kStepHeight, flat = std::sqrt(0.75) * (0.5 * kSide - 10);
        EXPECT_NEAR(firstOfFloor - lastOfTable - 1, yaw < 0 ? strip : 0, 2) << yaw;
        EXPECT_NEAR(floor, yaw < 0 ? flat : flat - strip, 2) << yaw;
    }
}

} // namespace
} // namespace nacre::test
