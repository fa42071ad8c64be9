#pragma once
#include <functional>
#include <span>

#include "acquisition/capture/observations.h"
#include "acquisition/near_field/local_lights.h"
#include "engine/brdf/brdf_table.h"

namespace nacre {

// A prediction misses where it is off by more than this share of the pixel's bright level.
constexpr float kRefitLimit = 0.225f;

// Answers what a normal shows under each of a pixel's lights: f.
using TableUnderLights =
    std::function<void(const glm::vec3& normal, std::span<const Light> lights, std::span<glm::vec3> values)>;

// The lights and the table are referred to.
TableUnderLights tableUnder(const LocalLights& lights, const BrdfTable& table);

// Of one pixel, for the lights before it that did not saturate it: what it shows and what the table predicts for a
// factor of 1, f n.l, both for irradiance 1.
struct PixelPrediction {
    std::vector<size_t> lights;
    std::vector<glm::vec3> observed, predicted;
    float limit = 0; // of a miss: kRefitLimit of the bright level
};

// `normal` and `lights` in the pixel's own frame. False where the pixel is black.
bool predictPixel(const Observations& block, size_t p, const glm::vec3& normal, std::span<const Light> lights,
                  const TableUnderLights& table, PixelPrediction& pixel);

} // namespace nacre
