// Heights from normals and cast shadows, on a block that stands on a floor: all normals face the camera.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/cast_shadows/full_height.h"
#include "acquisition/cast_shadows/shadow_height.h"
#include "engine/files/hash_random.h"
#include "engine/surface/height_from_normals.h"
#include "engine/surface/horizon.h"
#include "shared/glsl.h"

namespace nacre {
namespace {

constexpr int kSide = 64;
constexpr float kTall = 12; // pixels
constexpr int kLights = 16;

bool isOnBlock(int x, int y)
{
    return x >= 24 && x < 40 && y >= 20 && y < 44;
}

Image blockHeight(float tall, int side = kSide)
{
    Image height(side, side, 1);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            height.values[static_cast<size_t>(y) * side + x] =
                isOnBlock(x * kSide / side, y * kSide / side) ? tall : 0.0f;
        }
    }
    return height;
}

NormalMap flatNormals(int side = kSide)
{
    NormalMap normals(side, side);
    std::fill(normals.normals.begin(), normals.normals.end(), glm::vec3(0, 0, 1));
    std::fill(normals.confidence.begin(), normals.confidence.end(), 1.0f);
    return normals;
}

// Around the camera at 40 and 55 degrees from it in turn.
std::vector<glm::vec3> ringOfLights()
{
    std::vector<glm::vec3> lights;
    for (int i = 0; i < kLights; ++i) {
        const float azimuth = 2 * kPi * static_cast<float>(i) / kLights, slant = i % 2 == 0 ? 0.7f : 0.96f;
        lights.emplace_back(std::sin(slant) * std::cos(azimuth), std::sin(slant) * std::sin(azimuth), std::cos(slant));
    }
    return lights;
}

LitGrid gridOf(const Image& height)
{
    LitGrid grid{flatNormals(height.width), ringOfLights(), {}};
    const HorizonMap horizon = horizonMap(grid.normals, height);
    for (const glm::vec3& light : grid.lights) {
        const glm::vec4 lookup = horizonLookup(light, horizon.azimuths);
        for (size_t pixel = 0; pixel < height.values.size(); ++pixel) {
            grid.states.push_back(visibilityOf(horizon, lookup, pixel) > 0.5f ? LightState::lit : LightState::cast);
        }
    }
    return grid;
}

std::vector<size_t> allLights(size_t stride = 1)
{
    std::vector<size_t> lights;
    for (size_t i = 0; i < kLights; i += stride) {
        lights.push_back(i);
    }
    return lights;
}

// Of the block over the floor around it, within 8 pixels.
double stepOf(const Image& height)
{
    double block = 0, floor = 0, onBlock = 0, onFloor = 0;
    for (int y = 12; y < 52; ++y) {
        for (int x = 16; x < 48; ++x) {
            (isOnBlock(x, y) ? block : floor) += height.values[static_cast<size_t>(y) * kSide + x];
            ++(isOnBlock(x, y) ? onBlock : onFloor);
        }
    }
    return block / onBlock - floor / onFloor;
}

// Normals alone say that all is flat.
TEST(ShadowHeight, ABlockStandsAsHighAsItsShadowsAreLong)
{
    const LitGrid grid = gridOf(blockHeight(kTall));
    EXPECT_NEAR(stepOf(heightFromNormals(grid.normals).height), 0, 1e-3);
    // The floor rises towards the block by a tenth: that is as likely as a step so much higher.
    EXPECT_NEAR(stepOf(heightFromShadows(grid, allLights(), 1)), kTall, 0.15 * kTall);
}

TEST(ShadowHeight, WhereNothingCastsAShadowTheNormalsHeightStays)
{
    const LitGrid grid = gridOf(blockHeight(0));
    const Image height = heightFromShadows(grid, allLights(), 1);
    EXPECT_EQ(height.values, heightFromNormals(grid.normals).height.values);
}

TEST(ShadowHeight, AFewWrongStatesDoNotMoveIt)
{
    LitGrid grid = gridOf(blockHeight(kTall));
    uint64_t random = 1;
    for (LightState& state : grid.states) {
        if (nextRandom(random) % 100 == 0) {
            state = state == LightState::lit ? LightState::cast : LightState::lit;
        }
    }
    EXPECT_NEAR(stepOf(heightFromShadows(grid, allLights(), 1)), kTall, 0.3 * kTall);
}

// Shadows of the eight lights between those that the height was found by.
TEST(ShadowHeight, ForetellsTheShadowsOfLightsThatItHasNotSeen)
{
    const LitGrid grid = gridOf(blockHeight(kTall));
    const Image height = heightFromShadows(grid, allLights(2), 1);
    const HorizonMap horizon = horizonMap(grid.normals, height);
    size_t cast = 0, missed = 0, invented = 0;
    for (size_t light = 1; light < kLights; light += 2) {
        const glm::vec4 lookup = horizonLookup(grid.lights[light], horizon.azimuths);
        for (size_t pixel = 0; pixel < height.values.size(); ++pixel) {
            const bool isCast = grid.state(pixel, light) == LightState::cast,
                       isForetold = visibilityOf(horizon, lookup, pixel) <= 0.5f;
            cast += isCast;
            missed += isCast && !isForetold;
            invented += !isCast && isForetold;
        }
    }
    EXPECT_GT(cast, 1000u);
    // A border of a pixel's width around shadows of 10 to 17 pixels.
    EXPECT_LT(missed, cast / 6);
    EXPECT_LT(invented, cast / 6);
}

TEST(ShadowHeight, IsTheSameByAnyNumberOfThreads)
{
    const LitGrid grid = gridOf(blockHeight(kTall));
    EXPECT_EQ(heightFromShadows(grid, allLights(), 1).values, heightFromShadows(grid, allLights(), 3).values);
}

// A shadow that comes from beyond the picture has no caster, and steps are not made of nothing.
TEST(ShadowHeight, ShadowsFromBeyondTheObjectAreLeftAlone)
{
    LitGrid grid = gridOf(blockHeight(0));
    for (int y = 0; y < kSide; ++y) {
        for (int x = 40; x < kSide; ++x) {
            grid.state(grid.normals.index(x, y), 0) = LightState::cast; // the light stands on the right
        }
    }
    const Image height = heightFromShadows(grid, allLights(), 1);
    EXPECT_LT(*std::max_element(height.values.begin(), height.values.end()) -
                  *std::min_element(height.values.begin(), height.values.end()),
              0.5f);
}

TEST(ShadowHeight, StepsOfAThinnedMapStandInTheWholeOne)
{
    const int spacing = 2;
    const Image thinned = blockHeight(kTall / spacing, kSide / spacing);
    const Image full = fullHeight(flatNormals(), flatNormals(kSide / spacing), thinned, {spacing}, 1);
    EXPECT_NEAR(stepOf(full), kTall, 1); // ramps of a thinned pixel's width
    EXPECT_EQ(fullHeight(flatNormals(), flatNormals(), blockHeight(kTall), {}, 1).values, blockHeight(kTall).values);
}

TEST(LightState, IsToldByRadianceAndCosine)
{
    EXPECT_EQ(lightStateOf(0.5f, 0.95f, 1), LightState::lit);
    EXPECT_EQ(lightStateOf(0.5f, 0.6f, 1), LightState::unknown);
    EXPECT_EQ(lightStateOf(0.5f, 0.2f, 1), LightState::cast);
    EXPECT_EQ(lightStateOf(-0.5f, 0, 0), LightState::away);
    EXPECT_EQ(lightStateOf(0.05f, 0.01f, 0.05f), LightState::away);
    EXPECT_EQ(lightStateOf(0.05f, 0.05f, 0.05f), LightState::unknown);
}

} // namespace
} // namespace nacre
