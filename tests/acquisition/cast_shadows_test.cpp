// Heights from normals and cast shadows, on a block that stands on a floor: all normals face the camera.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/cast_shadows/full_height.h"
#include "acquisition/cast_shadows/shadow_height.h"
#include "acquisition/cast_shadows/shadow_lines.h"
#include "engine/files/hash_random.h"
#include "engine/surface/height_from_normals.h"
#include "engine/surface/horizon.h"
#include "engine/surface/object_places.h"
#include "shared/glsl.h"
#include "shared/lens.h"
#include "tests/support/ray_cast.h"

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
    LitGrid grid{flatNormals(height.width), {}, {}};
    const HorizonMap horizon = horizonMap(grid.normals, height);
    for (const glm::vec3& light : ringOfLights()) {
        grid.lights.emplace_back(light, 0);
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

// The block on its floor under lights with places, before a camera with a lens. Axis and origin of the grid are not
// those of space: its first pixel is (-31.5, 31.5) there.
LitGrid placedGrid(std::optional<float> lightDistance, std::optional<glm::dvec3> camera)
{
    LitGrid grid{flatNormals(), {}, {}};
    const Image height = blockHeight(kTall);
    for (const glm::vec3& direction : ringOfLights()) {
        glm::dvec4 light = lightDistance ? glm::dvec4(*lightDistance * direction, 1) : glm::dvec4(direction, 0);
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                grid.states.push_back(test::isHidden(height, camera, x, y, light) ? LightState::cast : LightState::lit);
            }
        }
        const float nearness = camera ? static_cast<float>(1 / glm::length(*camera)) : 0.0f;
        const glm::vec4 viewpoint(camera ? glm::vec3(glm::normalize(*camera)) : kFrontView, nearness);
        const glm::vec4 place = pointInPicture(viewpoint, glm::vec4(light));
        const glm::vec3 first(-31.5f, 31.5f, 0);
        grid.lights.emplace_back(glm::vec3(place) - place.w * first, place.w);
    }
    grid.cameraDistance = camera ? camera->z : grid.cameraDistance;
    return grid;
}

const glm::dvec3 kCamera(10, -4, 110); // 32 degrees

TEST(ShadowHeight, KnowsWhereNearLightsAndTheCameraStand)
{
    const double q = -kCamera.z * std::log(1 - kTall / kCamera.z); // of the top, by the normals' integral
    const LitGrid near = placedGrid(90.0f, {});
    const Image height = heightFromShadows(near, allLights(), 1);
    EXPECT_NEAR(stepOf(height), kTall, 0.15 * kTall);
    EXPECT_NEAR(outlineHeight(near.normals, height), 0, 1e-3);
    EXPECT_NEAR(stepOf(heightFromShadows(placedGrid({}, kCamera), allLights(), 1)), q, 0.15 * kTall);
    EXPECT_NEAR(stepOf(heightFromShadows(placedGrid(90.0f, kCamera), allLights(), 1)), q, 0.15 * kTall);
}

// In space, whatever the heights are.
TEST(GrazingRay, GoesFromItsPixelPastTheOtherToTheLight)
{
    std::vector<double> height(size_t{kSide} * kSide);
    for (size_t i = 0; i < height.size(); ++i) {
        height[i] = 5 + 5 * std::sin(0.37 * static_cast<double>(i));
    }
    const auto placeOf = [&](uint32_t pixel, double q, bool hasLens) {
        const uint32_t column = pixel % kSide, row = pixel / kSide;
        const glm::dvec2 seen(column - 31.5, 31.5 - row), axis(kCamera);
        const double z = hasLens ? kCamera.z * (1 - std::exp(-q / kCamera.z)) : q;
        return hasLens ? glm::dvec3(axis + (seen - axis) * (1 - z / kCamera.z), z) : glm::dvec3(seen, z);
    };
    for (const bool hasLens : {false, true}) {
        for (const std::optional<float> distance : {std::optional<float>(), std::optional(60.0f)}) {
            const LitGrid grid = placedGrid(distance, hasLens ? std::optional(kCamera) : std::optional<glm::dvec3>());
            for (size_t light = 0; light < kLights; ++light) {
                const glm::dvec3 direction(ringOfLights()[light]);
                const std::vector<GrazingRay> rays = shadowRays(grid, light, height);
                EXPECT_GT(rays.size(), 50u);
                for (const GrazingRay& ray : rays) {
                    const glm::dvec3 from = placeOf(ray.second, height[ray.second], hasLens),
                                     past = placeOf(ray.first, height[ray.second] + ray.rise, hasLens);
                    const glm::dvec3 towards =
                        distance ? glm::normalize(static_cast<double>(*distance) * direction - from) : direction;
                    // What casts ends half a step further on, and both pixels lie half a pixel from their line at most.
                    EXPECT_LT(glm::length(glm::cross(past - from, towards)), 1.2) << hasLens << distance.has_value();
                }
            }
        }
    }
}

// Lit ground behind a block that is not there.
TEST(GrazingRay, LitPixelsContradictWhatStandsInTheirLight)
{
    const LitGrid grid = gridOf(blockHeight(0));
    const Image block = blockHeight(kTall);
    const std::vector<double> flat(block.values.size(), 0.0), tall(block.values.begin(), block.values.end());
    EXPECT_TRUE(contradictedRays(grid, 0, flat).empty());
    const std::vector<GrazingRay> rays = contradictedRays(grid, 0, tall);
    // 24 rows, as far as the shadow reaches at 50 degrees: 10 pixels.
    EXPECT_NEAR(static_cast<double>(rays.size()), 24 * kTall * std::tan(0.7), 24 * 1.5);
    for (const GrazingRay& ray : rays) {
        EXPECT_TRUE(isOnBlock(ray.first % kSide, ray.first / kSide));
        EXPECT_FALSE(isOnBlock(ray.second % kSide, ray.second / kSide));
    }
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
        const glm::vec4 lookup = horizonLookup(glm::vec3(grid.lights[light]), horizon.azimuths);
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
