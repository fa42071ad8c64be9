#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "acquisition/brdf/albedo_factor.h"
#include "acquisition/capture/capture.h"
#include "engine/brdf/brdf_table.h"

namespace nacre {

// Takes out of the factors what goes with the slope (slope_trend.h), of materials whose pixels share an albedo: flat
// faces in colours of their own have such a trend, too. Answers for each material whether something was taken.
std::vector<uint8_t> takeSlopeTrends(const NormalMap& normals, const LocalLights& lights,
                                     std::span<const uint8_t> labels, std::span<const uint8_t> haveOneAlbedo,
                                     Image& albedo);

// refitAlbedo of albedo_factor.h with every pixel's own material; labels are indices into `tables`, null where a
// material's factors stay as they are.
void refitAlbedo(const Observations& block, const NormalMap& normals, const LocalLights& lights,
                 std::span<const uint8_t> labels, std::span<BrdfTable* const> tables, int threads, Image& albedo);

// Smooths factors in where the capture marks it, and makes their mean, or their median where they share one albedo, 1
// over each material's pixels: no material's factors reach another's. The tables take what was divided out; it is
// answered as well.
std::vector<glm::vec3> finishAlbedo(const Capture& capture, std::span<const uint8_t> labels,
                                    std::span<const uint8_t> haveOneAlbedo, std::span<BrdfTable* const> tables,
                                    Image& albedo);

} // namespace nacre
